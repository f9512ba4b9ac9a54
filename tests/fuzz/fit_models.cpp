#include "fuzz/fit_models.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace fuzz {
namespace {

using namespace meshcontour;

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::size_t kMostPoints = 28, kMostOfLong = 120;  // of one curve

// Draws a curve: each operation is a byte, three bits what and five how often, and mostly one argument.
class Turtle {
 public:
  Turtle(Source& source, std::size_t most) : source_(source), most_(most) {}

  // Up to an operation 7 without arguments left, or the end of the input.
  std::vector<Point> draw() {
    points_ = {at_};
    while (!source_.empty() && points_.size() < most_) {
      const std::uint8_t operation = source_.byte();
      if (operation == 0xff) break;
      apply(operation & 7, 1U + (operation >> 3));
    }
    return std::move(points_);
  }

 private:
  double signed_byte() { return static_cast<std::int8_t>(source_.byte()); }

  void apply(unsigned what, unsigned times) {
    switch (what) {
      case 0:
        return advance(times, 0, 0);
      case 1:
        return advance(times, signed_byte() / 4 * kDegree, 0);
      case 2:
        return advance(times, signed_byte() / 16 * kDegree, static_cast<double>(times) / 16 * kDegree);
      case 3:
        return turn(signed_byte() * kDegree * (180.0 / 127));
      case 4:
        return roll(static_cast<double>(times) * 11 * kDegree);
      case 5:
        return set_step(source_.byte());
      case 6:
        noise_ = std::ldexp(1.0, -2 * static_cast<int>(times));
        return;
      default:
        at_ += Vector(signed_byte(), signed_byte(), signed_byte()) / 8;
        points_.push_back(at_);
    }
  }

  void advance(unsigned times, double angle, double growth) {
    for (unsigned i = 0; i < times && points_.size() < most_; ++i) {
      turn(angle / 2);
      at_ += step_ * forward_;
      turn(angle / 2);
      angle += growth;
      points_.push_back(at_ + noise_ * Vector(random(), random(), random()));
    }
  }

  void turn(double angle) {
    const Vector side = up_.cross(forward_);
    forward_ = (std::cos(angle) * forward_ + std::sin(angle) * side).normalized();
  }

  void roll(double angle) {
    up_ = (std::cos(angle) * up_ + std::sin(angle) * forward_.cross(up_)).normalized();
  }

  void set_step(std::uint8_t code) {
    constexpr std::array kSteps = {0.0, 1e-9, 2e-9, 1e-16, 1e-80, 1e-200, 1e-310, 1e6};
    step_ = code < kSteps.size() ? kSteps[code] : std::exp2((code - 128) / 16.0);
  }

  // From -1 to 1.
  double random() {
    state_ = state_ * 1664525U + 1013904223U;
    return static_cast<double>(state_ >> 8) / (1 << 23) - 1;
  }

  Source& source_;
  std::size_t most_;
  Point at_ = Point::Zero();
  Vector forward_ = Vector::UnitX(), up_ = Vector::UnitZ();
  double step_ = 1, noise_ = 0;
  std::uint32_t state_ = 1;
  std::vector<Point> points_;
};

using Ring = std::vector<Index>;  // the corners of one polygon

// Patches are lists of polygons; each becomes a fan.
class PatchBuilder {
 public:
  std::vector<Index> add(const std::vector<Point>& points) {
    std::vector<Index> numbers;
    for (const Point& p : points) {
      numbers.push_back(static_cast<Index>(shell_.points.size()));
      shell_.points.push_back(p);
    }
    return numbers;
  }

  void add_patch(std::vector<Ring> rings, bool own_points) {
    const std::size_t first = shell_.triangles.size();
    for (Ring& ring : rings) {
      if (own_points) {
        for (Index& v : ring) {
          shell_.points.push_back(Point(shell_.points[v]));
          v = static_cast<Index>(shell_.points.size() - 1);
        }
      }
      for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        shell_.triangles.push_back({ring[0], ring[i], ring[i + 1]});
    }
    if (shell_.triangles.size() > first) {
      shell_.patches.push_back({"", {}, first, shell_.triangles.size() - first});
    }
  }

  Shell take() {
    shell_.id = "s";
    return std::move(shell_);
  }

 private:
  Shell shell_;
};

// a and then b backwards, without the ends that b shares with a.
Ring joined(std::vector<Index> a, const std::vector<Index>& b) {
  for (std::size_t i = b.size() - 1; i-- > 1;) a.push_back(b[i]);
  return a;
}

// The points of a curve from the vertex `from` to the vertex `to`.
std::vector<Index> chain(PatchBuilder& builder, std::vector<Point> points, Index from, Index to,
                         const Point& start) {
  points.erase(points.begin());
  for (Point& p : points) p += start;
  std::vector<Index> numbers = builder.add(points);
  numbers.insert(numbers.begin(), from);
  numbers.push_back(to);
  return numbers;
}

// Three chains between the same two vertices.
void add_lens(PatchBuilder& builder, Source& source, std::size_t most, const Vector& shift, bool own) {
  std::vector<Point> first = Turtle(source, most).draw();
  for (Point& p : first) p += shift;
  const std::vector<Index> a = builder.add(first);
  const auto further = [&] {
    return chain(builder, Turtle(source, most).draw(), a.front(), a.back(), first.front());
  };
  const std::vector<Index> b = further(), c = further();
  if (a.size() < 2) return;
  builder.add_patch({joined(a, b)}, own);
  builder.add_patch({joined(b, c)}, own);
}

// A closed curve that two neighbours see in parts.
void add_parted_ring(PatchBuilder& builder, Source& source, std::size_t most, const Vector& shift, bool own) {
  const std::size_t cut = 1 + source.byte() % 32U;
  std::vector<Point> points = Turtle(source, most).draw();
  for (Point& p : points) p += shift;
  const std::vector<Index> ring = builder.add(points);
  if (ring.size() < cut + 2) return;
  builder.add_patch({ring}, own);
  const auto at = ring.begin() + static_cast<std::ptrdiff_t>(cut);
  std::vector<Index> a(ring.begin(), at + 1), b(at, ring.end());
  b.push_back(ring.front());
  const std::vector<Point> outer = Turtle(source, most).draw();
  builder.add_patch({joined(chain(builder, outer, a.front(), a.back(), points[0]), a)}, own);
  builder.add_patch({joined(chain(builder, outer, b.front(), b.back(), points[cut]), b)}, own);
}

void add_disc_in_hole(PatchBuilder& builder, Source& source, std::size_t most, const Vector& shift,
                      bool own) {
  std::vector<Point> inner = Turtle(source, most).draw(), outer = Turtle(source, most).draw();
  for (Point& p : inner) p += shift;
  for (Point& p : outer) p += 3 * shift;
  const Ring hole = builder.add(inner);
  builder.add_patch({builder.add(outer), hole}, own);
  builder.add_patch({{hole.rbegin(), hole.rend()}}, own);
}

void add_polygon(PatchBuilder& builder, Source& source, std::size_t most, const Vector& shift, bool own) {
  std::vector<Point> points = Turtle(source, most).draw();
  for (Point& p : points) p += shift;
  builder.add_patch({builder.add(points)}, own);
}

void place(Shell& shell, std::uint8_t size, std::uint8_t rounding) {
  constexpr std::array kExponents = {0, 0, 0, 0, 4, -10, 40, -40, 200, -200, 228, -228, 234, -234, 330, -330};
  constexpr std::array kOffsets = {0.0, 0.0, 1e3, -1e6};
  const Vector offset = Vector::Constant(kOffsets[size >> 6]);
  for (Point& p : shell.points) {
    p += offset;
    if (rounding % 4 == 1) p = p.cast<float>().cast<double>();
    if (rounding % 4 == 2) p = (p * 1e4).array().round().matrix() / 1e4;
    p *= std::ldexp(1.0, kExponents[size % kExponents.size()]);
  }
}

// The points as they come, as a chain that does not close.
FitModel open_chain(Source& source, std::size_t most) {
  FitModel result;
  Shell& shell = result.model.shells.emplace_back();
  shell.points = Turtle(source, most).draw();
  std::vector<Index> vertices;
  for (std::size_t i = 0; i < shell.points.size(); ++i) vertices.push_back(static_cast<Index>(i));
  result.boundaries.resize(1);
  PatchBoundary& patch = result.boundaries[0].patches.emplace_back();
  patch.loops = std::vector<BoundaryLoop>{{vertices, false}};
  return result;
}

}  // namespace

FitModel fit_model_of(Source& source) {
  const std::uint8_t layout = source.byte(), size = source.byte(), rounding = source.byte();
  const std::size_t most = layout & 0x80 ? kMostOfLong : kMostPoints;
  const std::size_t copies = (layout & 0x60) == 0x60 ? 3 : 1;
  const bool own = layout & 0x10;
  FitModel result;
  if (layout % 5 == 4) {
    result = open_chain(source, most);
  } else {
    constexpr std::array kAdd = {add_polygon, add_lens, add_parted_ring, add_disc_in_hole};
    PatchBuilder builder;
    for (std::size_t copy = 0; copy < copies; ++copy) {
      Source again = source;
      kAdd[layout % 5](builder, again, most, static_cast<double>(copy) * Vector::UnitZ(), own);
    }
    result.model.shells.push_back(builder.take());
  }
  Shell& shell = result.model.shells[0];
  place(shell, size, rounding);
  if (!result.boundaries.empty()) return result;
  std::vector<Diagnostic> diagnostics;
  result.boundaries = extract_boundaries(result.model, {Extractor::Sorted, 1}, diagnostics);
  return result;
}

}  // namespace fuzz

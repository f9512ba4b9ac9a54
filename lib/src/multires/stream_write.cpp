#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "meshcontour/wavelet.hpp"
#include "meshcontour/wavelet_stream.hpp"
#include "multires/stream_blocks.hpp"

namespace meshcontour {
namespace {

using detail::ByteWriter;

constexpr std::size_t kBlockDetails = 1 << 13;  // what a cut at most loses
constexpr double kRounding = 0.4;

// A shell as its coarse mesh and whole multiples of a step.
struct Coded {
  Shell base;
  unsigned levels = 0;
  double step = 0;  // of the finest details
  Point corner = Point::Zero();
  std::vector<std::array<std::int64_t, 3>> places;   // of the base's vertices
  std::vector<std::array<std::int64_t, 3>> details;  // of those behind
};

void write_color(const Rgba& color, ByteWriter& out) {
  for (const std::uint8_t channel : {color.red, color.green, color.blue, color.alpha}) out.byte(channel);
}

// Small ones become zero sooner than half a step says: that costs little and saves more.
std::int64_t rounded(double value) {
  return static_cast<std::int64_t>(std::copysign(std::floor(std::abs(value) + kRounding), value));
}

// Points of the coarse mesh as whole multiples of a step from a corner of their box.
void round_base(Coded& out) {
  const double step = detail::detail_step(out.step, 0, out.levels) / 2;
  out.corner = bounding_box(out.base).min();
  for (Point& p : out.base.points) {
    const Vector multiple = ((p - out.corner) / step).array().round();
    out.places.push_back({std::llround(multiple[0]), std::llround(multiple[1]), std::llround(multiple[2])});
    p = out.corner + step * multiple;
  }
}

// Details level by level, each in frames that follow from those before, as they are read.
void round_details(const WaveletTransform& transform, std::span<const Point> details, Coded& out) {
  std::vector<Point> points(details.begin(), details.end());
  std::ranges::copy(out.base.points, points.begin());
  for (unsigned level = 0; level < out.levels; ++level) {
    const std::vector<Eigen::Matrix3d> frames = transform.detail_frames(level, points);
    const double step = detail::detail_step(out.step, level, out.levels);
    Index vertex = transform.vertex_count(level);
    for (const Eigen::Matrix3d& frame : frames) {
      const Vector multiple =
          (frame.transpose() * points[vertex]).cwiseQuotient(frame.colwise().squaredNorm().transpose()) /
          step;
      const std::array<std::int64_t, 3> whole = {rounded(multiple[0]), rounded(multiple[1]),
                                                 rounded(multiple[2])};
      out.details.push_back(whole);
      points[vertex++] = step * (frame * Vector(double(whole[0]), double(whole[1]), double(whole[2])));
    }
    transform.synthesise(level, std::span(points).first(transform.vertex_count(level + 1)));
  }
}

// The coefficients, and the coarse mesh whose points they belong to.
Coded coded(const Shell& shell, const WaveletStreamOptions& options) {
  Coded out;
  SubdivisionConnectivity connectivity = find_subdivision(shell);
  out.levels = connectivity.levels;
  out.base = out.levels > 0 ? std::move(connectivity.base) : shell;
  if (out.levels == 0) return out;
  const double size = bounding_box(shell).diagonal().norm();
  out.step = options.precision * (size > 0 ? size : 1);
  const WaveletTransform transform(out.base, out.levels, options.subdivide);
  std::vector<Point> points(connectivity.order.size());
  for (std::size_t v = 0; v < points.size(); ++v) points[v] = shell.points[connectivity.order[v]];
  transform.analyse(points);
  std::copy_n(points.begin(), out.base.points.size(), out.base.points.begin());
  round_base(out);
  round_details(transform, points, out);
  return out;
}

void write_points(const Coded& coded, ByteWriter& out) {
  out.count(coded.base.points.size());
  if (coded.levels == 0) {
    for (const Point& p : coded.base.points) {
      for (const double x : p) out.number(x);
    }
    return;
  }
  for (const double x : coded.corner) out.number(x);
  for (std::size_t k = 0; k < 3; ++k) {
    std::int64_t last = 0;
    for (const auto& place : coded.places) {
      out.integer(place[k] - last);
      last = place[k];
    }
  }
}

void write_mesh(const Coded& coded, ByteWriter& out) {
  const Shell& base = coded.base;
  out.text(base.id);
  write_color(base.color, out);
  out.count(coded.levels);
  out.number(coded.step);
  write_points(coded, out);
  out.count(base.patches.size());
  for (const Patch& patch : base.patches) {
    out.text(patch.name);
    write_color(patch.color, out);
    out.count(patch.triangle_count);
  }
  out.count(base.triangles.size());
  std::int64_t last = 0;
  for (const Triangle& t : base.triangles) {
    for (const Index v : t) {
      out.integer(static_cast<std::int64_t>(v) - last);
      last = v;
    }
  }
  const auto wanted = [](const auto& d) { return d[0] != 0 || d[1] != 0 || d[2] != 0; };
  out.count(static_cast<std::uint64_t>(std::ranges::count_if(coded.details, wanted)));
}

std::string base_bytes(const Model& model, const std::vector<Coded>& shells,
                       const WaveletStreamOptions& options) {
  ByteWriter out;
  out.text(model.name);
  out.number(model.metres_per_unit);
  out.byte(model.has_patches);
  out.byte(options.subdivide.boundary == BoundaryRule::Trigonometric);
  out.byte(options.subdivide.creases);
  out.count(shells.size());
  for (const Coded& shell : shells) write_mesh(shell, out);
  out.count(model.instances.size());
  for (const Instance& instance : model.instances) {
    out.count(instance.shell);
    for (Eigen::Index i = 0; i < 12; ++i) out.number(instance.placement.matrix()(i / 4, i % 4));
    out.text(instance.path);
  }
  return out.take();
}

// The number of bits of the largest of three numbers.
int bits_of(const std::array<std::int64_t, 3>& detail) {
  std::uint64_t all = 0;
  for (const std::int64_t x : detail) all |= static_cast<std::uint64_t>(x < 0 ? -x : x);
  return static_cast<int>(std::bit_width(all));
}

// Coefficients with these numbers: their places, then coordinate by coordinate, as each packs best by itself.
void write_block(std::size_t shell, const Coded& coded, std::span<const std::size_t> chosen,
                 detail::BlockWriter& blocks) {
  std::array<ByteWriter, 4> parts;
  parts[0].count(shell);
  parts[0].count(chosen.size());
  std::size_t next = 0;
  for (const std::size_t i : chosen) {
    parts[0].count(i - next);
    next = i + 1;
    for (std::size_t k = 0; k < 3; ++k) parts[k + 1].integer(coded.details[i][k]);
  }
  const std::array<std::string_view, 4> bytes = {parts[0].bytes(), parts[1].bytes(), parts[2].bytes(),
                                                 parts[3].bytes()};
  blocks.write(detail::BlockKind::Details, bytes);
}

// The coefficients of one shell whose largest number has so many bits, in order.
void write_details(std::size_t shell, const Coded& coded, int bits, detail::BlockWriter& blocks) {
  std::vector<std::size_t> chosen;
  const auto flush = [&] {
    if (!chosen.empty()) write_block(shell, coded, chosen, blocks);
    chosen.clear();
  };
  for (std::size_t i = 0; i < coded.details.size(); ++i) {
    if (bits_of(coded.details[i]) != bits) continue;
    chosen.push_back(i);
    if (chosen.size() == kBlockDetails) flush();
  }
  flush();
}

}  // namespace

void write_wavelet_stream(const Model& model, const WaveletStreamOptions& options, Sink& sink,
                          std::vector<Diagnostic>& notes) {
  if (!(options.precision > 0 && options.precision < 1)) {
    throw Error(ErrorCode::Usage,
                fmt::format("precision {}: expected a number between 0 and 1", options.precision));
  }
  std::vector<Coded> shells;
  std::size_t whole = 0;
  int most = 0;
  for (const Shell& shell : model.shells) {
    shells.push_back(coded(shell, options));
    whole += shells.back().levels == 0;
    for (const auto& detail : shells.back().details) most = std::max(most, bits_of(detail));
  }
  if (whole > 0) {
    notes.push_back({Diagnostic::Severity::Note,
                     "shell whose triangles come from no subdivision, written as it is",
                     {},
                     whole});
  }
  detail::BlockWriter blocks(sink);
  blocks.write(detail::BlockKind::Base, base_bytes(model, shells, options));
  // Steps differ between shells; what counts is how large the coefficients are beside the shell.
  for (int bits = most; bits > 0; --bits) {
    for (std::size_t s = 0; s < shells.size(); ++s) write_details(s, shells[s], bits, blocks);
  }
  blocks.end();
}

}  // namespace meshcontour

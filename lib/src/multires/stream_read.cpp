#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "meshcontour/wavelet.hpp"
#include "meshcontour/wavelet_stream.hpp"
#include "multires/stream_blocks.hpp"

namespace meshcontour {
namespace {

using detail::Block;
using detail::BlockKind;
using detail::ByteReader;

constexpr unsigned kMostLevels = 16;
constexpr std::uint64_t kMostPoints = std::uint64_t{1} << 31;
constexpr std::int64_t kLargestDetail = std::int64_t{1} << 40;  // in steps
constexpr std::int64_t kLargestPlace = std::int64_t{1} << 52;   // in steps, of a coarse mesh's points
constexpr std::uint64_t kMostExpansion = 4096;  // of the coarse meshes' bytes, beyond which a file is a trap

// A shell while its coefficients come in.
struct Incoming {
  Shell base;
  unsigned levels = 0;
  double step = 0;
  std::uint64_t expected = 0, seen = 0;  // coefficients
  std::size_t most = 0;                  // that there can be
  std::vector<Point> details;            // up to the finest that came, in steps along their frames
};

class StreamReader {
 public:
  StreamReader(std::string_view bytes, std::string_view name, std::uint64_t max_triangles, unsigned threads)
      : size_(bytes.size()), name_(name), blocks_(bytes, name), max_triangles_(max_triangles) {
    options_.threads = threads;
  }

  Model read() {
    bool whole = false;
    std::optional<Block> block = read_base();
    for (; block && !whole; block = whole ? std::nullopt : blocks_.next()) {
      if (block->kind == BlockKind::Base) fail("coarse meshes follow coefficients");
      if (block->kind == BlockKind::End) {
        whole = true;
      } else {
        read_details(block->bytes);
      }
    }
    std::uint64_t missing = 0;
    for (const Incoming& shell : incoming_) missing += shell.expected - std::min(shell.seen, shell.expected);
    if (!whole) {
      model_.diagnostics.push_back(
          {Diagnostic::Severity::Warning,
           fmt::format("the stream ends early: {} coefficients are missing", missing),
           {name_, 0, 0, {}}});
    } else if (missing > 0) {
      fail(fmt::format("{} coefficients are missing", missing));
    }
    for (Incoming& shell : incoming_) model_.shells.push_back(refined(shell, whole));
    return std::move(model_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { ByteReader({}, name_).fail(what); }

  // Returns the first block behind the coarse meshes.
  std::optional<Block> read_base() {
    std::string bytes;
    std::optional<Block> block = blocks_.next();
    for (; block && block->kind == BlockKind::Base; block = blocks_.next()) {
      bytes += block->bytes;
      if (bytes.size() / kMostExpansion > size_) {
        throw Error(ErrorCode::OutOfMemory, "wavelet stream: its coarse meshes are too large for its size",
                    {name_, 0, 0, {}});
      }
    }
    ByteReader in(bytes, name_);
    model_.name = in.text();
    model_.metres_per_unit = in.number();
    if (model_.metres_per_unit < 0) in.fail("its unit is negative");
    model_.has_patches = in.fixed(1) != 0;
    options_.boundary = in.fixed(1) != 0 ? BoundaryRule::Trigonometric : BoundaryRule::Reflect;
    options_.creases = in.fixed(1) != 0;
    for (std::uint64_t count = in.count(in.remaining()); count > 0; --count)
      incoming_.push_back(read_shell(in));
    for (std::uint64_t count = in.count(in.remaining()); count > 0; --count) read_instance(in);
    if (in.remaining() > 0) in.fail("bytes follow the coarse meshes");
    return block;
  }

  static Rgba read_color(ByteReader& in) {
    Rgba color;
    for (std::uint8_t* channel : {&color.red, &color.green, &color.blue, &color.alpha}) {
      *channel = static_cast<std::uint8_t>(in.fixed(1));
    }
    return color;
  }

  Incoming read_shell(ByteReader& in) {
    Incoming shell;
    shell.base.id = in.text();
    shell.base.color = read_color(in);
    shell.levels = static_cast<unsigned>(in.count(kMostLevels));
    shell.step = in.number();
    if (shell.step < 0) in.fail("a step is negative");
    read_points(in, shell);
    read_patches(in, shell);
    shell.expected = in.count(kMostPoints);
    return shell;
  }

  static void read_points(ByteReader& in, Incoming& shell) {
    if (shell.levels == 0) {
      for (std::uint64_t count = in.count(in.remaining() / 24); count > 0; --count) {
        const double x = in.number(), y = in.number(), z = in.number();
        shell.base.points.push_back({x, y, z});
      }
      return;
    }
    const std::uint64_t count = in.count(in.remaining() / 3);
    const double x = in.number(), y = in.number(), z = in.number();
    shell.base.points.assign(count, Point(x, y, z));
    const double step = detail::detail_step(shell.step, 0, shell.levels) / 2;
    for (Eigen::Index k = 0; k < 3; ++k) {
      std::int64_t place = 0;
      for (Point& p : shell.base.points) {
        place += in.integer();
        if (place > kLargestPlace || place < 0) in.fail("a point is out of range");
        p[k] += step * static_cast<double>(place);
        if (!std::isfinite(p[k])) in.fail("a point is out of range");
      }
    }
  }

  void read_patches(ByteReader& in, Incoming& shell) {
    std::uint64_t triangles = 0;
    for (std::uint64_t count = in.count(in.remaining()); count > 0; --count) {
      Patch patch;
      patch.name = in.text();
      patch.color = read_color(in);
      patch.first_triangle = triangles;
      patch.triangle_count = in.count(in.remaining() / 3);
      triangles += patch.triangle_count;
      shell.base.patches.push_back(std::move(patch));
    }
    if (in.count(in.remaining() / 3) != triangles) in.fail("patches do not make up their shell");
    std::int64_t last = 0;
    for (; triangles > 0; --triangles) {
      Triangle& t = shell.base.triangles.emplace_back();
      for (Index& v : t) {
        last += in.integer();
        if (last < 0 || last >= static_cast<std::int64_t>(shell.base.points.size())) {
          in.fail("a triangle names a point that is not there");
        }
        v = static_cast<Index>(last);
      }
    }
    check_size(shell);
  }

  // Quadrupled by each level: together no more than the limit.
  void check_size(Incoming& shell) {
    const std::uint64_t base = shell.base.triangles.size(), fine = base << (2 * shell.levels);
    if (base > max_triangles_ || fine > max_triangles_ || triangles_ + fine > max_triangles_) {
      throw Error(ErrorCode::OutOfMemory,
                  fmt::format("wavelet stream: more than {} triangles", max_triangles_), {name_, 0, 0, {}});
    }
    triangles_ += fine;
    // Every level has no more than three new points a triangle of the one before.
    if (shell.levels > 0) shell.most = static_cast<std::size_t>(fine);
  }

  void read_instance(ByteReader& in) {
    Instance instance;
    instance.shell = in.count(incoming_.size());
    if (instance.shell >= incoming_.size()) in.fail("an instance names a shell that is not there");
    for (Eigen::Index i = 0; i < 12; ++i) instance.placement.matrix()(i / 4, i % 4) = in.number();
    instance.path = in.text();
    model_.instances.push_back(std::move(instance));
  }

  void read_details(std::string_view bytes) {
    ByteReader in(bytes, name_);
    const std::uint64_t number = in.count(incoming_.size());
    if (number >= incoming_.size()) in.fail("a coefficient names a shell that is not there");
    Incoming& shell = incoming_[number];
    std::vector<std::size_t> chosen(in.count(in.remaining() / 4));
    std::size_t next = 0;
    for (std::size_t& at : chosen) {
      at = next + in.count(kMostPoints);
      if (at >= shell.most) in.fail("a coefficient belongs to no vertex");
      next = at + 1;
    }
    if (next > shell.details.size()) shell.details.resize(next, Point::Zero());
    for (Eigen::Index k = 0; k < 3; ++k) {
      for (const std::size_t at : chosen) {
        const std::int64_t value = in.integer();
        if (value > kLargestDetail || value < -kLargestDetail) in.fail("a coefficient is out of range");
        shell.details[at][k] = static_cast<double>(value);
      }
    }
    shell.seen += chosen.size();
    if (in.remaining() > 0) in.fail("bytes follow the coefficients of a block");
  }

  // The mesh of the finest level, or where coefficients are missing of the finest one that has some.
  Shell refined(Incoming& shell, bool whole) const {
    Shell out = std::move(shell.base);
    if (shell.levels == 0 || (!whole && shell.details.empty())) return out;
    std::size_t coarse = out.points.size();
    unsigned levels = shell.levels;
    if (!whole) levels = levels_for(out, coarse + shell.details.size(), shell.levels);
    const WaveletTransform transform(out, levels, options_);
    std::vector<Point> points(transform.vertex_count(levels), Point::Zero());
    if (coarse + shell.details.size() > points.size()) fail("a coefficient belongs to no vertex");
    std::ranges::copy(out.points, points.begin());
    std::ranges::copy(shell.details, points.begin() + static_cast<std::ptrdiff_t>(coarse));
    for (unsigned level = 0; level < levels; ++level) refine(transform, level, shell, points);
    for (const Point& p : points) {
      if (!p.allFinite()) fail("its points are not finite");
    }
    out.points = std::move(points);
    const auto triangles = transform.triangles(levels);
    out.triangles.assign(triangles.begin(), triangles.end());
    for (Patch& patch : out.patches) {
      patch.first_triangle <<= 2 * levels;
      patch.triangle_count <<= 2 * levels;
    }
    return out;
  }

  // From multiples of the step along the frames of a level to its details, then on to the next level.
  static void refine(const WaveletTransform& transform, unsigned level, const Incoming& shell,
                     std::vector<Point>& points) {
    const double step = detail::detail_step(shell.step, level, shell.levels);
    Index vertex = transform.vertex_count(level);
    for (const Eigen::Matrix3d& frame : transform.detail_frames(level, points)) {
      points[vertex] = step * (frame * points[vertex]);
      ++vertex;
    }
    transform.synthesise(level, std::span(points).first(transform.vertex_count(level + 1)));
  }

  // The fewest levels with so many vertices.
  unsigned levels_for(const Shell& base, std::size_t vertices, unsigned most) const {
    for (unsigned levels = 1; levels < most; ++levels) {
      if (WaveletTransform(base, levels, options_).vertex_count(levels) >= vertices) return levels;
    }
    return most;
  }

  std::size_t size_;
  std::string name_;
  detail::BlockReader blocks_;
  std::uint64_t max_triangles_, triangles_ = 0;
  SubdivisionOptions options_;
  Model model_;
  std::vector<Incoming> incoming_;
};

}  // namespace

bool is_wavelet_stream(std::string_view head) {
  return head.starts_with(detail::kStreamSignature);
}

Model read_wavelet_stream(std::string_view bytes, std::string_view name, std::uint64_t max_triangles,
                          unsigned threads) {
  return StreamReader(bytes, name, max_triangles, threads).read();
}

}  // namespace meshcontour

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

constexpr std::size_t kBlockBytes = 1 << 14;  // of coefficients: what a cut at most loses

// A shell as its coarse mesh and whole multiples of a step.
struct Coded {
  Shell base;
  unsigned levels = 0;
  double step = 0;
  Index base_vertices = 0;
  std::vector<std::array<std::int64_t, 3>> details;  // of the vertices behind the base's
};

void write_color(const Rgba& color, ByteWriter& out) {
  for (const std::uint8_t channel : {color.red, color.green, color.blue, color.alpha}) out.byte(channel);
}

// The coefficients, and the coarse mesh whose points they belong to.
Coded coded(const Shell& shell, const WaveletStreamOptions& options) {
  Coded out;
  SubdivisionConnectivity connectivity = find_subdivision(shell);
  out.levels = connectivity.levels;
  out.base = out.levels > 0 ? std::move(connectivity.base) : shell;
  out.base_vertices = static_cast<Index>(out.base.points.size());
  if (out.levels == 0) return out;
  const double size = bounding_box(shell).diagonal().norm();
  out.step = options.precision * (size > 0 ? size : 1);
  const WaveletTransform transform(out.base, out.levels, options.subdivide);
  std::vector<Point> points(connectivity.order.size());
  for (std::size_t v = 0; v < points.size(); ++v) points[v] = shell.points[connectivity.order[v]];
  transform.analyse(points);
  std::copy_n(points.begin(), out.base_vertices, out.base.points.begin());
  out.details.resize(points.size() - out.base_vertices);
  for (std::size_t i = 0; i < out.details.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      out.details[i][k] =
          std::llround(points[out.base_vertices + i][static_cast<Eigen::Index>(k)] / out.step);
    }
  }
  return out;
}

void write_mesh(const Coded& coded, ByteWriter& out) {
  const Shell& base = coded.base;
  out.text(base.id);
  write_color(base.color, out);
  out.count(coded.levels);
  out.number(coded.step);
  out.count(base.points.size());
  for (const Point& p : base.points) {
    for (const double x : p) out.number(x);
  }
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

// The coefficients of one shell whose largest number has so many bits, in order.
void write_details(std::size_t shell, const Coded& coded, int bits, detail::BlockWriter& blocks) {
  ByteWriter out;
  std::size_t next = 0;
  const auto flush = [&] {
    if (!out.bytes().empty()) blocks.write(detail::BlockKind::Details, out.take());
    out = {};
  };
  for (std::size_t i = 0; i < coded.details.size(); ++i) {
    if (bits_of(coded.details[i]) != bits) continue;
    if (out.bytes().empty()) {
      out.count(shell);
      next = 0;
    }
    out.count(i - next);
    next = i + 1;
    for (const std::int64_t x : coded.details[i]) out.integer(x);
    if (out.bytes().size() >= kBlockBytes) flush();
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

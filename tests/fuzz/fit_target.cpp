// Contours of any loop: finite, joined, and no farther from the loop than their own certificate says.

#include <algorithm>
#include <cmath>
#include <limits>

#include "fuzz/targets.hpp"
#include "meshcontour/fit.hpp"

namespace fuzz {
namespace {

using namespace meshcontour;

// A closed polygon of up to 200 points as a fan of triangles; the second byte scales its coordinates.
Model polygon_of(Source& source) {
  const double scale = std::ldexp(1.0, 2 * (source.byte() % 64) - 64);
  Shell shell;
  shell.id = "s";
  while (!source.empty() && shell.points.size() < 200) {
    Point point;
    for (int k = 0; k < 3; ++k) point[k] = scale * static_cast<std::int16_t>(source.word());
    shell.points.push_back(point);
  }
  for (Index i = 1; i + 1 < shell.points.size(); ++i) shell.triangles.push_back({0, i, i + 1});
  shell.patches.push_back({"", {}, 0, shell.triangles.size()});
  Model model;
  model.shells.push_back(std::move(shell));
  return model;
}

double distance_to_chord(const Point& p, const Point& a, const Point& b) {
  const Vector along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0;
  return (a + t * along - p).norm();
}

double distance_to_loop(const Point& p, const Shell& shell, const BoundaryLoop& loop) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
    const Index next = loop.vertices[(i + 1) % loop.vertices.size()];
    least = std::min(least, distance_to_chord(p, shell.points[loop.vertices[i]], shell.points[next]));
  }
  return least;
}

void check(const Contour& contour, const Shell& shell, const BoundaryLoop& loop) {
  const double size = bounding_box(shell).diagonal().norm();
  require(!contour.segments.empty(), "a contour without segments");
  require(std::isfinite(contour.deviation) && contour.deviation >= 0, "a deviation that is none");
  constexpr int kSamples = 16;
  Point last = evaluate(contour.segments.back().curve, 1);
  for (const Segment& segment : contour.segments) {
    require((evaluate(segment.curve, 0) - last).norm() <= 1e-6 * size, "segments that do not meet");
    for (int k = 0; k <= kSamples; ++k) {
      const Point p = evaluate(segment.curve, static_cast<double>(k) / kSamples);
      require(p.allFinite(), "a point that is not finite");
      require(distance_to_loop(p, shell, loop) <= segment.deviation * (1 + 1e-6) + 1e-9 * size,
              "a curve farther from its loop than it says");
      last = p;
    }
  }
}

}  // namespace

void fit_loop(Bytes input) {
  Source source(input);
  const std::uint8_t choice = source.byte();
  FitOptions options;
  options.method = static_cast<FitMethod>(choice % 4);
  options.threads = 1;
  const Model model = polygon_of(source);
  const Shell& shell = model.shells[0];
  if (shell.triangles.empty()) return;
  if (choice & 4) options.tolerance = 1e-2 * std::max(bounding_box(shell).diagonal().norm(), 1e-300);
  std::vector<Diagnostic> diagnostics;
  const auto boundaries = extract_boundaries(model, {Extractor::Sorted, 1}, diagnostics);
  const auto contours = fit_contours(model, boundaries, options, diagnostics);
  const auto& loops = boundaries[0].patches[0].loops;
  require(contours.size() == loops.size(), "another number of contours than of loops");
  for (const Contour& contour : contours) {
    if (contour.closed) check(contour, shell, loops[contour.loop]);
  }
}

}  // namespace fuzz

#include "fit/loop.hpp"

#include <cmath>

namespace meshcontour::detail {
namespace {

constexpr double kSmallestDiagonal = 1e-70, kLargestDiagonal = 1e70;

}  // namespace

Loop make_loop(std::span<const Point> shell_points, const BoundaryLoop& boundary) {
  std::vector<Point> points;
  points.reserve(boundary.vertices.size());
  for (const Index v : boundary.vertices) points.push_back(shell_points[v]);
  Loop loop;
  loop.closed = boundary.closed;
  loop.cleaned = clean_points(points, boundary.closed);
  for (const std::size_t i : loop.cleaned.origin) loop.vertices.push_back(boundary.vertices[i]);
  return loop;
}

bool is_usable_size(double diagonal) {
  return diagonal <= kLargestDiagonal && (diagonal >= kSmallestDiagonal || diagonal == 0);
}

LoopDefect find_defect(const Loop& loop) {
  if (!is_usable_size(loop.cleaned.diagonal)) return LoopDefect::OutOfRange;
  if (loop.vertices.size() < (loop.closed ? 3U : 2U)) return LoopDefect::TooFewPoints;
  return LoopDefect::None;
}

Contour polygon_contour(const Loop& loop) {
  const std::vector<Point>& points = loop.cleaned.points;
  Contour contour;
  contour.closed = loop.closed;
  contour.fallback = true;
  contour.deviation = loop.cleaned.dropped;
  const std::size_t count = points.size();
  const std::size_t chords = loop.closed || count < 2 ? count : count - 1;
  for (std::size_t i = 0; i < chords; ++i) {
    const std::size_t next = (i + 1) % count;
    Segment segment;
    segment.from = loop.vertices[i];
    segment.to = loop.vertices[next];
    segment.curve = LineSegment{points[i], points[next]};
    segment.deviation = loop.cleaned.dropped;
    contour.segments.push_back(segment);
  }
  return contour;
}

}  // namespace meshcontour::detail

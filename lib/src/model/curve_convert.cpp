// Every curve as a clamped B-spline.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "meshcontour/curve.hpp"
#include "model/blossom.hpp"
#include "model/conic.hpp"

namespace meshcontour {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2;

BSplineCurve clamped(const LineSegment& line) {
  return {1, {0, 0, 1, 1}, {line.start, line.end}, {}, false};
}

// Quadratic pieces between equal parameters; the middle control point is where the tangents meet
// [Piegl & Tiller 1997, section 7.3].
BSplineCurve clamped(const detail::ConicFrame& frame) {
  const int pieces = std::max(1, static_cast<int>(std::ceil(frame.angle / kQuarterTurn - 1e-9)));
  const double step = frame.angle / pieces, weight = std::cos(step / 2);
  BSplineCurve result;
  result.degree = 2;
  result.knots = {0, 0, 0};
  result.control_points = {frame.start};
  result.weights = {1};
  for (int piece = 0; piece < pieces; ++piece) {
    const double begin = frame.begin + piece * step;
    const Point middle = frame.at(begin + step / 2);
    const bool last = piece + 1 == pieces;
    result.control_points.push_back(frame.center + (middle - frame.center) / weight);
    result.control_points.push_back(last ? frame.end : frame.at(begin + step));
    result.weights.insert(result.weights.end(), {weight, 1});
    result.knots.insert(result.knots.end(), last ? 3 : 2, piece + 1);
  }
  return result;
}

bool is_clamped(const BSplineCurve& curve) {
  const auto [begin, end] = curve.domain();
  return !curve.periodic && curve.knots.front() == begin && curve.knots.back() == end;
}

// Inner knots as they are; the ends at full multiplicity. `first` is the first span that is not empty.
std::vector<double> clamped_knots(const BSplineCurve& curve, std::size_t first) {
  const auto [begin, end] = curve.domain();
  const std::size_t last = find_span(curve, end);
  const auto at = [&](std::size_t i) { return curve.knots.begin() + static_cast<std::ptrdiff_t>(i); };
  std::vector<double> knots(static_cast<std::size_t>(curve.degree) + 1, begin);
  knots.insert(knots.end(), at(first + 1), at(last + 1));
  knots.insert(knots.end(), static_cast<std::size_t>(curve.degree) + 1, end);
  return knots;
}

BSplineCurve clamped(const BSplineCurve& curve) {
  if (is_clamped(curve)) return curve;
  const auto degree = static_cast<std::size_t>(curve.degree);
  const auto [begin, end] = curve.domain();
  const std::size_t first = find_span(curve, begin), last = find_span(curve, end);
  BSplineCurve result;
  result.degree = curve.degree;
  result.knots = clamped_knots(curve, first);
  const std::size_t count = result.knots.size() - degree - 1;
  for (std::size_t i = 0; i < count; ++i) {
    if (i >= degree && i + degree < count) {  // none of its knots is new
      result.control_points.push_back(curve.control_points[first + i - degree]);
      if (!curve.weights.empty()) result.weights.push_back(curve.weights[first + i - degree]);
      continue;
    }
    const auto knot = [&](int r) { return result.knots[i + static_cast<std::size_t>(r)]; };
    const Eigen::Vector4d point = detail::blossom(curve, i < degree ? first : last, knot);
    result.control_points.push_back(detail::projected(curve, point));
    if (!curve.weights.empty()) result.weights.push_back(point[3]);
  }
  if (curve.periodic) {  // the same point to the last bit
    result.control_points.back() = result.control_points.front();
    if (!curve.weights.empty()) result.weights.back() = result.weights.front();
  }
  return result;
}

BSplineCurve clamped(const CircularArc& arc) {
  return clamped(detail::conic_frame(arc));
}
BSplineCurve clamped(const EllipticalArc& arc) {
  return clamped(detail::conic_frame(arc));
}

}  // namespace

BSplineCurve to_clamped_bspline(const Curve& curve) {
  return std::visit([](const auto& c) { return clamped(c); }, curve);
}

}  // namespace meshcontour

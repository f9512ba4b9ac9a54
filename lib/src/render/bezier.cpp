#include "render/bezier.hpp"

#include <algorithm>
#include <cmath>

#include "model/blossom.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kMaxChords = 1024;

}  // namespace

BezierCurve to_bezier(const BSplineCurve& curve, const Point& center, double size) {
  BezierCurve result;
  const auto degree = static_cast<std::size_t>(curve.degree);
  result.degree = curve.degree;
  result.rational = !curve.weights.empty();
  for (std::size_t span = degree; span < curve.control_points.size(); ++span) {
    const double begin = curve.knots[span], end = curve.knots[span + 1];
    if (!(begin < end)) continue;
    for (int k = result.control.empty() ? 0 : 1; k <= curve.degree; ++k) {
      result.control.push_back(
          blossom(curve, span, [&](int argument) { return argument <= curve.degree - k ? begin : end; }));
    }
  }
  for (Eigen::Vector4d& p : result.control) p.head<3>() = (p.head<3>() - p.w() * center) / size;
  return result;
}

std::vector<float> packed_control(const BezierCurve& curve, std::size_t first, std::size_t pieces) {
  const auto degree = static_cast<std::size_t>(curve.degree);
  std::vector<float> packed;
  packed.reserve((pieces * degree + 1) * (curve.rational ? 4 : 3));
  for (std::size_t i = first * degree; i <= (first + pieces) * degree; ++i) {
    const Eigen::Vector4f p = curve.control[i].cast<float>();
    packed.insert(packed.end(), p.data(), p.data() + (curve.rational ? 4 : 3));
  }
  return packed;
}

int chords(const BezierCurve& curve, std::size_t piece, double tolerance) {
  const auto degree = static_cast<std::size_t>(curve.degree);
  const Eigen::Vector4d* p = &curve.control[piece * degree];
  double difference = 0, smallest = p[0].w(), largest = p[0].w();
  for (std::size_t i = 1; i <= degree; ++i) {
    smallest = std::min(smallest, p[i].w());
    largest = std::max(largest, p[i].w());
    if (i < 2) continue;
    const Vector second = p[i].hnormalized() - 2 * p[i - 1].hnormalized() + p[i - 2].hnormalized();
    difference = std::max(difference, second.norm());
  }
  const double ratio = largest / smallest;
  const double factor = static_cast<double>(degree * (degree - 1)) / 8.0;
  const double count = std::sqrt(factor * difference * ratio * ratio / tolerance);
  return count < kMaxChords ? std::max(1, static_cast<int>(std::ceil(count))) : static_cast<int>(kMaxChords);
}

}  // namespace meshcontour::detail

#include "render/bezier.hpp"

#include <algorithm>
#include <cmath>

#include "model/blossom.hpp"
#include "model/segment_distance.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kMaxChords = 1024;

using Homogeneous = Eigen::Vector4d;

// The blossom of a cubic piece where one argument replaces another: `u` between the knots `low` and `high`.
Homogeneous between(const Homogeneous& a, const Homogeneous& b, double low, double high, double u) {
  const double share = (u - low) / (high - low);
  return (1 - share) * a + share * b;
}

// The last three Bezier points of a cubic span, and the first where there is none yet: what blossom() gives,
// without what its calls for one span have in common.
void add_cubic_span(const BSplineCurve& curve, std::size_t span, std::vector<Homogeneous>& control) {
  const double* t = curve.knots.data() + span;
  const auto point = [&](std::size_t back) { return homogeneous_point(curve, span - back); };
  const Homogeneous p1 = point(2), p2 = point(1);
  const Homogeneous first = between(p1, p2, t[-1], t[2], t[0]), second = between(p1, p2, t[-1], t[2], t[1]);
  if (control.empty()) {
    control.push_back(between(between(point(3), p1, t[-2], t[1], t[0]), first, t[-1], t[1], t[0]));
  }
  const Homogeneous last = between(second, between(p2, point(0), t[0], t[3], t[1]), t[0], t[2], t[1]);
  control.insert(control.end(), {first, second, last});
}

void add_span(const BSplineCurve& curve, std::size_t span, std::vector<Homogeneous>& control) {
  const double begin = curve.knots[span], end = curve.knots[span + 1];
  for (int k = control.empty() ? 0 : 1; k <= curve.degree; ++k) {
    control.push_back(
        blossom(curve, span, [&](int argument) { return argument <= curve.degree - k ? begin : end; }));
  }
}

}  // namespace

BezierCurve to_bezier(const BSplineCurve& curve, const Point& center, double size) {
  BezierCurve result;
  const auto degree = static_cast<std::size_t>(curve.degree);
  result.degree = curve.degree;
  result.rational = !curve.weights.empty();
  result.control.reserve(degree * (curve.control_points.size() - degree) + 1);
  for (std::size_t span = degree; span < curve.control_points.size(); ++span) {
    if (!(curve.knots[span] < curve.knots[span + 1])) continue;
    if (degree == 3) {
      add_cubic_span(curve, span, result.control);
    } else {
      add_span(curve, span, result.control);
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

double chord_error(const BezierCurve& curve, std::size_t piece) {
  const auto degree = static_cast<std::size_t>(curve.degree);
  const Eigen::Vector4d* p = &curve.control[piece * degree];
  double difference = 0, smallest = p[0].w(), largest = p[0].w();
  for (std::size_t i = 1; i <= degree; ++i) {
    smallest = std::min(smallest, p[i].w());
    largest = std::max(largest, p[i].w());
    if (i < 2) continue;
    const Vector second =
        curve.rational ? Vector(p[i].hnormalized() - 2 * p[i - 1].hnormalized() + p[i - 2].hnormalized())
                       : Vector((p[i] - 2 * p[i - 1] + p[i - 2]).head<3>());
    difference = std::max(difference, second.squaredNorm());
  }
  const double ratio = largest / smallest;
  const double factor = static_cast<double>(degree * (degree - 1)) / 8.0;
  return factor * std::sqrt(difference) * ratio * ratio;
}

int chords(double error, double tolerance) {
  if (error <= tolerance) return 1;
  const double count = std::sqrt(error / tolerance);
  return static_cast<int>(count < kMaxChords ? std::ceil(count) : kMaxChords);
}

void join_chords(std::vector<Chord>& row, double tolerance) {
  for (std::size_t before = row.size() + 1; row.size() < before;) {
    before = row.size();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < before; ++kept) {
      const Chord chord = row[i++];
      row[kept] = chord;
      if (i == before || chord.start == row[i].end) continue;
      const double error =
          std::max(chord.error, row[i].error) + segment_distance(chord.end, chord.start, row[i].end);
      if (error <= tolerance) row[kept] = {chord.start, row[i++].end, error};
    }
    row.resize(kept);
  }
}

}  // namespace meshcontour::detail

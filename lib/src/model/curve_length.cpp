// Arc length by adaptive Gauss-Kronrod quadrature of the speed.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "meshcontour/curve.hpp"
#include "model/conic.hpp"

namespace meshcontour {
namespace {

constexpr double kRelativeTolerance = 1e-11;
constexpr double kRounding = 1e-15;  // of a length, relative to the coordinates
constexpr int kMaxDepth = 48;

// Nodes and weights of the 15-point Kronrod rule; every other node is one of the 7-point Gauss rule
// [Piessens et al. 1983, QUADPACK, routine QK15].
constexpr std::array<double, 8> kNodes = {
    0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
    0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
    0.586087235467691130294144691693506, 0.405845151377397166906606412076961,
    0.207784955007898467600689403773245, 0.0};
constexpr std::array<double, 8> kKronrodWeights = {
    0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
    0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
    0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
    0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
constexpr std::array<double, 4> kGaussWeights = {
    0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
    0.381830050505118944950369775488975, 0.417959183673469387755102040816327};

struct Estimate {
  double value = 0, error = 0;
};

template <typename Speed>
Estimate quadrature(const Speed& speed, double begin, double end) {
  const double middle = (begin + end) / 2, half = (end - begin) / 2;
  double kronrod = kKronrodWeights[7] * speed(middle);
  double gauss = kGaussWeights[3] * speed(middle);
  for (std::size_t i = 0; i < 7; ++i) {
    const double sum = speed(middle - half * kNodes[i]) + speed(middle + half * kNodes[i]);
    kronrod += kKronrodWeights[i] * sum;
    if (i % 2 == 1) gauss += kGaussWeights[i / 2] * sum;
  }
  return {kronrod * half, std::abs(kronrod - gauss) * half};
}

// Halves the interval until each part's error is a small share of the first estimate, or below `noise`, what
// the rounding of the coordinates makes of the length.
template <typename Speed>
double integral(const Speed& speed, double begin, double end, double noise) {
  struct Part {
    double begin, end;
    int depth;
    Estimate estimate;
  };
  std::vector<Part> parts{{begin, end, 0, quadrature(speed, begin, end)}};
  const double allowed = kRelativeTolerance * parts.front().estimate.value;
  double sum = 0;
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    if (part.estimate.error <= std::max(noise, std::ldexp(allowed, -part.depth / 2)) ||
        part.depth == kMaxDepth) {
      sum += part.estimate.value;
      continue;
    }
    const double middle = (part.begin + part.end) / 2;
    parts.push_back({middle, part.end, part.depth + 1, quadrature(speed, middle, part.end)});
    parts.push_back({part.begin, middle, part.depth + 1, quadrature(speed, part.begin, middle)});
  }
  return sum;
}

double arc_length(const LineSegment& line) {
  return (line.end - line.start).norm();
}

double arc_length(const CircularArc& arc) {
  return arc.radius * arc.angle;
}

double arc_length(const EllipticalArc& arc) {
  const detail::ConicFrame frame = detail::conic_frame(arc);
  const double noise = kRounding * frame.first.norm();
  return integral([&](double t) { return frame.speed(t); }, frame.begin, frame.begin + frame.angle, noise);
}

// A polynomial piece is integrated from its Taylor coefficients at the middle, which is many times faster.
double span_length(const BSplineCurve& curve, double begin, double end, double noise) {
  if (!curve.weights.empty()) {
    return integral([&](double u) { return derivatives(curve, u, 1).row(1).norm(); }, begin, end, noise);
  }
  const double middle = (begin + end) / 2;
  Eigen::MatrixX3d coefficients = derivatives(curve, middle, curve.degree);
  double factorial = 1;
  for (int k = 2; k <= curve.degree; ++k) coefficients.row(k) /= (factorial *= k - 1);
  const auto speed = [&](double u) {
    Eigen::RowVector3d sum = coefficients.row(curve.degree);
    for (int k = curve.degree - 1; k >= 1; --k) sum = (u - middle) * sum + coefficients.row(k);
    return sum.norm();
  };
  return integral(speed, begin, end, noise);
}

double arc_length(const BSplineCurve& curve) {
  double sum = 0, largest = 0;
  for (const Point& p : curve.control_points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  for (auto i = static_cast<std::size_t>(curve.degree); i < curve.control_points.size(); ++i) {
    const double begin = curve.knots[i], end = curve.knots[i + 1];
    if (begin < end) sum += span_length(curve, begin, end, kRounding * largest);
  }
  return sum;
}

}  // namespace

double length(const Curve& curve) {
  return std::visit([](const auto& c) { return arc_length(c); }, curve);
}

}  // namespace meshcontour

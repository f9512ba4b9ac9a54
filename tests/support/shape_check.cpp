#include "support/shape_check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace shapes {

using namespace meshcontour;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

double uniform(std::mt19937& random) {
  return static_cast<double>(random()) / 4294967296.0;
}

double normal(std::mt19937& random) {
  const double u = 1 - uniform(random), v = uniform(random);
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

Eigen::Affine3d placement(const Disturbance& disturbance, std::mt19937& random) {
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  if (disturbance.rotate) {
    Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
    map.linear() = q.normalized().toRotationMatrix();
  }
  map.linear() *= disturbance.scale;
  map.translation().setConstant(disturbance.offset);
  return map;
}

double rounded(double x, const Disturbance& disturbance) {
  if (disturbance.single) x = static_cast<double>(static_cast<float>(x));
  if (disturbance.decimals < 0) return x;
  const double scale = std::pow(10.0, disturbance.decimals);
  return std::round(x * scale) / scale;
}

char kind_of(const Curve& curve) {
  if (std::holds_alternative<LineSegment>(curve)) return 'L';
  if (const auto* arc = std::get_if<CircularArc>(&curve)) return arc->full() ? 'C' : 'A';
  return std::holds_alternative<EllipticalArc>(curve) ? 'E' : 'S';
}

Vector direction(const Curve& curve, bool at_end) {
  const double step = 1e-6;
  if (at_end) return (evaluate(curve, 1) - evaluate(curve, 1 - step)).normalized();
  return (evaluate(curve, step) - evaluate(curve, 0)).normalized();
}

int count_corners(const Contour& contour) {
  int corners = 0;
  const std::size_t n = contour.segments.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Segment &here = contour.segments[i], &next = contour.segments[(i + 1) % n];
    if (n == 1 && kind_of(here.curve) != 'S') continue;
    if (const auto* spline = std::get_if<BSplineCurve>(&here.curve); n == 1 && spline->periodic) continue;
    const Vector a = direction(here.curve, true), b = direction(next.curve, false);
    const bool lines = kind_of(here.curve) == 'L' && kind_of(next.curve) == 'L';
    if (std::atan2(a.cross(b).norm(), a.dot(b)) > (lines ? 0.25 : 2) * kDegree) ++corners;
  }
  return corners;
}

double distance_to_edge(const Point& p, const Edge& edge) {
  constexpr int kSteps = 300;
  double best = 1e300;
  int at = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double d = (edge.at(edge.begin + (edge.end - edge.begin) * i / kSteps) - p).norm();
    if (d < best) best = d, at = i;
  }
  double low = std::max(at - 1, 0), high = std::min(at + 1, kSteps);
  const auto distance = [&](double i) {
    return (edge.at(edge.begin + (edge.end - edge.begin) * i / kSteps) - p).norm();
  };
  for (int step = 0; step < 80; ++step) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    if (distance(a) < distance(b))
      high = b;
    else
      low = a;
  }
  return std::min(best, distance((low + high) / 2));
}

double error_of(const Curve& curve, const Edge& edge) {
  double worst = 0;
  for (int i = 0; i <= 8; ++i) worst = std::max(worst, distance_to_edge(evaluate(curve, i / 8.0), edge));
  return worst;
}

}  // namespace

std::vector<Disturbance> disturbances() {
  std::vector<Disturbance> list(11);
  list[0] = {.name = "none"};
  list[1] = {.name = "rotation", .rotate = true, .repeats = 2};
  list[2] = {.name = "start", .shift = true, .repeats = 3};
  list[3] = {.name = "reversal", .shift = true, .reverse = true, .repeats = 2};
  list[4] = {.name = "x 1e-6", .scale = 1e-6};
  list[5] = {.name = "+ 1e6", .rotate = true, .offset = 1e6};
  list[6] = {.name = "single", .rotate = true, .single = true, .repeats = 2};
  list[7] = {.name = "4 decimals", .rotate = true, .decimals = 4, .repeats = 2};
  list[8] = {.name = "noise 1e-7", .rotate = true, .shift = true, .noise = 1e-7, .repeats = 2};
  list[9] = {.name = "noise 1e-6", .rotate = true, .shift = true, .noise = 1e-6, .repeats = 2};
  list[10] = {.name = "noise 1e-5", .rotate = true, .shift = true, .noise = 1e-5, .repeats = 2};
  return list;
}

Check check_shape(const Shape& original, double tau, Steps steps, const Disturbance& disturbance,
                  unsigned seed) {
  std::mt19937 random(1000 * seed + 17);
  const Shape shape = moved(original, placement(disturbance, random));
  const double extent = size(shape);
  const Loop loop = tessellate(shape, tau * extent, steps);
  const std::size_t n = loop.points.size(), shift = disturbance.shift ? random() % n : 0;
  std::vector<Point> points(n);
  const auto place = [&](std::size_t i) {
    const std::size_t turned = (i + n - shift) % n;
    return disturbance.reverse ? (n - turned) % n : turned;
  };
  for (std::size_t i = 0; i < n; ++i) {
    Point p = loop.points[i];
    for (double& x : p) x = rounded(x + disturbance.noise * extent * normal(random), disturbance);
    points[place(i)] = p;
  }
  std::vector<Diagnostic> diagnostics;
  FitOptions options;
  options.method = FitMethod::Primitives;
  options.threads = 1;
  const Contour contour = fit_contours(model_of(points), boundary_of(points), options, diagnostics)[0];
  Check check;
  check.corners = count_corners(contour);
  check.deviation = contour.deviation / extent;
  std::map<std::size_t, const Segment*> by_start;
  for (const Segment& segment : contour.segments)
    by_start[disturbance.reverse ? segment.to : segment.from] = &segment;
  check.kinds_exact = contour.segments.size() == shape.edges.size() && !contour.fallback;
  for (std::size_t e = 0; e < shape.edges.size(); ++e) {
    auto found = by_start.find(place(loop.joints[e]));
    if (found == by_start.end() && shape.edges.size() == 1) found = by_start.begin();
    if (found == by_start.end()) check.kinds_exact = false;
    const char kind = found == by_start.end() ? '-' : kind_of(found->second->curve);
    check.kinds_exact = check.kinds_exact && kind == shape.edges[e].kind;
    check.found += kind;
    if (kind == shape.edges[e].kind && kind != 'S') {
      check.primitive_error =
          std::max(check.primitive_error, error_of(found->second->curve, shape.edges[e]) / extent);
    }
  }
  if (contour.segments.size() != shape.edges.size())
    check.found += " of " + std::to_string(contour.segments.size());
  return check;
}

}  // namespace shapes

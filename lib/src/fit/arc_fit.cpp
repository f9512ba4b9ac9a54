#include "fit/arc_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace meshcontour::detail {

namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr std::size_t kSamples = 64;  // fitted points of a long run

// Places 1 .. count-2 of a run, thinned to about kSamples.
template <class Visit>
void visit_inner(std::size_t count, Visit visit) {
  const std::size_t inner = count - 2;
  const std::size_t samples = std::min(inner, kSamples);
  for (std::size_t s = 0; s < samples; ++s) visit(1 + (2 * s + 1) * inner / (2 * samples));
}

// The chord's frame and the side to which the points bulge.
struct ChordFrame {
  Point middle;
  Vector along, bulge;
  double half = 0;
  bool valid = false;
};

ChordFrame chord_frame(std::span<const Point> points) {
  ChordFrame frame;
  const Vector chord = points.back() - points.front();
  const double length = chord.norm();
  if (!(length > 0)) return frame;
  frame.along = chord / length;
  frame.half = length / 2;
  frame.middle = (points.front() + points.back()) / 2;
  const Vector a = frame.along.unitOrthogonal(), b = frame.along.cross(a);
  double aa = 0, ab = 0, bb = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  visit_inner(points.size(), [&](std::size_t i) {
    const Vector v = points[i] - frame.middle;
    const double x = v.dot(a), y = v.dot(b);
    aa += x * x;
    ab += x * y;
    bb += y * y;
    sum += Eigen::Vector2d(x, y);
  });
  if (!(aa + bb > 0)) return frame;
  const double roll = 0.5 * std::atan2(2 * ab, aa - bb);
  Eigen::Vector2d direction(std::cos(roll), std::sin(roll));
  if (direction.dot(sum) < 0) direction = -direction;
  frame.bulge = (direction.x() * a + direction.y() * b).normalized();
  frame.valid = true;
  return frame;
}

// Height of the centre over the chord: algebraic start, then Gauss-Newton on the distance to the circle.
double centre_height(std::span<const Point> points, const ChordFrame& frame) {
  const double c = frame.half;
  double above = 0, below = 0;
  visit_inner(points.size(), [&](std::size_t i) {
    const Vector v = points[i] - frame.middle;
    const double x = v.dot(frame.along), y = v.dot(frame.bulge);
    above += y * (x * x + y * y - c * c);
    below += 2 * y * y;
  });
  double k = above / below;
  for (int step = 0; step < 4; ++step) {
    const double radius = std::hypot(c, k);
    double gradient = 0, curvature = 0;
    visit_inner(points.size(), [&](std::size_t i) {
      const Vector v = points[i] - frame.middle;
      const double x = v.dot(frame.along), y = v.dot(frame.bulge);
      const double r = std::sqrt(x * x + (y - k) * (y - k));
      if (!(r > 0)) return;
      const double slope = (k - y) / r - k / radius;
      gradient += slope * (r - radius);
      curvature += slope * slope;
    });
    if (!(curvature > 0)) break;
    const double change = gradient / curvature;
    k -= change;
    if (!(std::abs(change) > 1e-15 * radius)) break;
  }
  return k;
}

// Largest distance to the arc's circle; negative when a point is farther than the limit.
double checked_residual(const CircularArc& arc, std::span<const Point> points, double limit) {
  double worst = 0;
  for (auto p = points.rbegin(); p != points.rend(); ++p) {  // a run that is too long fails at its end
    const double distance = distance_to_circle(arc, *p);
    if (!(distance <= limit)) return -1;
    worst = std::max(worst, distance);
  }
  return worst;
}

// The turn of the points about the arc's axis; negative when one step is backwards or too wide. Whole turns
// are counted where the points pass the first one.
double checked_sweep(const CircularArc& arc, std::span<const Point> points, bool closed) {
  const double steepest = std::tan(kLargestStep) * (1 + 1e-12);
  const Vector first = points[0] - arc.center, sideways = arc.axis.cross(first);
  Vector before = first;
  double turns = 0, side = 0;
  const std::size_t steps = closed ? points.size() : points.size() - 1;
  for (std::size_t i = 0; i < steps; ++i) {
    const Vector here = points[i + 1 < points.size() ? i + 1 : 0] - arc.center;
    const double across = before.cross(here).dot(arc.axis);
    if (!(across > 0 && across <= steepest * before.dot(here))) return -1;
    const double side_before = side;
    side = closed && i + 1 == steps ? 0 : sideways.dot(here);
    if (side_before < 0 && side >= 0 && first.dot(here) > 0) ++turns;
    before = here;
  }
  const double angle = std::atan2(side, first.dot(before));
  return angle + kTwoPi * (angle < 0 ? turns + 1 : turns);
}

}  // namespace

std::optional<double> line_residual(std::span<const Point> points, double limit) {
  const Point& start = points.front();
  const Vector chord = points.back() - start;
  const double length = chord.norm();
  if (!(length > 0)) return std::nullopt;
  const Vector along = chord / length;
  double worst = 0, before = length;
  for (std::size_t i = points.size() - 1; i-- > 1;) {
    const Vector v = points[i] - start;
    const double x = v.dot(along);
    const double distance = (v - x * along).norm();
    if (!(distance <= limit) || !(x < before) || !(x > 0)) return std::nullopt;
    worst = std::max(worst, distance);
    before = x;
  }
  return worst;
}

std::optional<ArcFit> fit_arc(std::span<const Point> points, double limit) {
  const ChordFrame frame = chord_frame(points);
  if (!frame.valid) return std::nullopt;
  const double k = centre_height(points, frame);
  if (!std::isfinite(k)) return std::nullopt;
  ArcFit fit;
  CircularArc& arc = fit.arc;
  arc.start = points.front();
  arc.end = points.back();
  arc.center = frame.middle + k * frame.bulge;
  arc.axis = frame.bulge.cross(frame.along).normalized();
  arc.radius = std::hypot(frame.half, k);
  arc.angle = 2 * std::atan2(frame.half, -k);
  if (arc.angle < 0) arc.angle += kTwoPi;
  const double sagitta = arc.radius * (1 - std::cos(arc.angle / 2));
  if (!(sagitta > 3 * limit) || arc.radius > 2e4 * frame.half) return std::nullopt;
  fit.residual = checked_residual(arc, points, limit);
  if (fit.residual < 0) return std::nullopt;
  const double sweep = checked_sweep(arc, points, false);
  if (sweep < 0 || std::abs(sweep - arc.angle) > 1e-3) return std::nullopt;
  return fit;
}

namespace {

// Centre and radius in the plane: Kasa's linear fit, then Gauss-Newton on the distances.
bool fit_plane_circle(const std::vector<Eigen::Vector2d>& points, Eigen::Vector2d& centre, double& radius) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Eigen::Vector2d& p : points) {
    const Eigen::Vector3d row(2 * p.x(), 2 * p.y(), 1);
    normal += row * row.transpose();
    right += p.squaredNorm() * row;
  }
  const Eigen::Vector3d kasa = normal.ldlt().solve(right);
  centre = kasa.head<2>();
  radius = std::sqrt(kasa.z() + centre.squaredNorm());
  for (int step = 0; step < 4; ++step) {
    normal.setZero();
    right.setZero();
    for (const Eigen::Vector2d& p : points) {
      const Eigen::Vector2d v = p - centre;
      const double distance = v.norm();
      if (!(distance > 0)) return false;
      const Eigen::Vector3d row(-v.x() / distance, -v.y() / distance, -1);
      normal += row * row.transpose();
      right -= (distance - radius) * row;
    }
    const Eigen::Vector3d change = normal.ldlt().solve(right);
    centre += change.head<2>();
    radius += change.z();
    if (!(change.norm() > 1e-15 * radius)) break;
  }
  return centre.allFinite() && std::isfinite(radius) && radius > 0;
}

}  // namespace

std::optional<ArcFit> fit_circle(std::span<const Point> ring, double limit) {
  const std::size_t n = ring.size();
  Point mean = Point::Zero();
  for (const Point& p : ring) mean += p;
  mean /= static_cast<double>(n);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Vector area = Vector::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector v = ring[i] - mean, next = ring[(i + 1) % n] - mean;
    covariance += v * v.transpose();
    area += v.cross(next);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> frame(covariance);
  if (!(frame.eigenvalues()(1) > 0)) return std::nullopt;
  ArcFit fit;
  CircularArc& arc = fit.arc;
  arc.axis = frame.eigenvectors().col(0).normalized();
  if (arc.axis.dot(area) < 0) arc.axis = -arc.axis;
  const Vector x = arc.axis.unitOrthogonal(), y = arc.axis.cross(x);
  // A few points tell what is no circle; those of one are then fitted all.
  for (const std::size_t samples : {std::min(n, kSamples), n}) {
    std::vector<Eigen::Vector2d> flat(samples);
    for (std::size_t s = 0; s < samples; ++s) {
      const Vector v = ring[s * n / samples] - mean;
      flat[s] = {v.dot(x), v.dot(y)};
    }
    Eigen::Vector2d centre;
    if (!fit_plane_circle(flat, centre, arc.radius)) return std::nullopt;
    arc.center = mean + centre.x() * x + centre.y() * y;
    fit.residual = checked_residual(arc, ring, samples < n ? 4 * limit : limit);
    if (fit.residual < 0) return std::nullopt;
    if (samples == n) break;
  }
  const double sweep = checked_sweep(arc, ring, true);
  if (!(std::abs(sweep - kTwoPi) < 1e-6)) return std::nullopt;
  const Vector spoke = ring[0] - arc.center;
  arc.start = arc.center + arc.radius * (spoke - spoke.dot(arc.axis) * arc.axis).normalized();
  arc.end = arc.start;
  arc.angle = kTwoPi;
  return fit;
}

double distance_to_circle(const CircularArc& arc, const Point& point) {
  const Vector v = point - arc.center;
  const double height = v.dot(arc.axis);
  const double off = (v - height * arc.axis).norm() - arc.radius;
  return std::sqrt(off * off + height * height);
}

}  // namespace meshcontour::detail

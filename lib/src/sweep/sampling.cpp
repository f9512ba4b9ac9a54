#include "sweep/sampling.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace meshcontour::detail {
namespace {

constexpr double kSameFraction = 1e-9;   // of the size: points closer than this are one
constexpr double kStandstill = 1e-10;    // of the size: a derivative shorter than this vanishes
constexpr double kRoundOff = 1e-14;      // of the distance from the origin: a box no larger is one point
constexpr double kLeastLength = 1e-140;  // model units: squares of shorter lengths lose their digits
constexpr double kSameTangent = 1 - 1e-9;

enum class Side { Before, After };

using Basis = Eigen::Matrix4d;  // row k: the k-th derivatives of the four basis functions of a piece

// Nodes and weights on [0, 1] of the 5-point Gauss-Legendre rule [Abramowitz & Stegun 1964, table 25.4].
struct GaussNode {
  double position, weight;
};
constexpr std::array<GaussNode, 5> kGauss = {{
    {0.5 - 0.5 * 0.9061798459386640, 0.5 * 0.2369268850561891},
    {0.5 - 0.5 * 0.5384693101056831, 0.5 * 0.4786286704993665},
    {0.5, 0.5 * 0.5688888888888889},
    {0.5 + 0.5 * 0.5384693101056831, 0.5 * 0.4786286704993665},
    {0.5 + 0.5 * 0.9061798459386640, 0.5 * 0.2369268850561891},
}};

// The basis functions of a piece over [0, 1]; all pieces of a chain have the same. They are cubic, so that
// their derivatives at 0 say all about them.
class PieceBasis {
 public:
  explicit PieceBasis(SweepCurve::Kind kind) {
    static const std::vector<double> bezier = {0, 0, 0, 0, 1, 1, 1, 1};
    static const std::vector<double> uniform = {-3, -2, -1, 0, 1, 2, 3, 4};
    at_start_ = basis_functions(kind == SweepCurve::Kind::Bezier ? bezier : uniform, 3, 3, 0, 3);
  }

  Basis at(double t) const {
    Basis basis = at_start_;
    for (int k = 0; k < 3; ++k) {
      for (int m = 3; m > k; --m) basis.row(k) += power(t, m - k) * at_start_.row(m);
    }
    return basis;
  }

 private:
  // t^m / m!
  static double power(double t, int m) { return m == 1 ? t : m == 2 ? t * t / 2 : t * t * t / 6; }

  Basis at_start_;
};

// One cubic piece: its control points, and how to combine them.
class Piece {
 public:
  Piece(const SweepCurve& curve, std::size_t index)
      : points_(curve.control_points.data() + index * (curve.kind == SweepCurve::Kind::Bezier ? 3 : 1)) {}

  Point position(const Basis& basis) const {
    Point sum = Point::Zero();
    for (int k = 0; k < 4; ++k) sum += basis(0, k) * points_[k];
    return sum;
  }

  // From differences of the control points, so that a curve far from the origin loses nothing.
  Vector derivative(const Basis& basis, int order) const {
    Vector sum = Vector::Zero();
    for (int k = 1; k < 4; ++k) sum += basis(order, k) * (points_[k] - points_[0]);
    return sum;
  }

 private:
  const Point* points_;
};

// The motion on one side of a point. Where the first derivative vanishes, q'(h) ~ h q'' + h^2/2 q''' gives
// the limit.
Motion motion_of(const Piece& piece, const Basis& basis, double standstill, Side side) {
  Motion motion;
  const Vector first = piece.derivative(basis, 1), second = piece.derivative(basis, 2);
  const double speed = first.norm();
  if (speed > standstill) {
    motion.speed = speed;
    motion.tangent = first / speed;
    motion.turn = (second - second.dot(motion.tangent) * motion.tangent) / speed;
    return motion;
  }
  const Vector third = piece.derivative(basis, 3);
  if (second.norm() > standstill) {
    motion.tangent = side == Side::After ? second.normalized() : -second.normalized();
  } else if (third.norm() > standstill) {
    motion.tangent = third.normalized();
  }
  return motion;
}

double standstill_of(const SweepCurve& curve) {
  Box box;
  for (const Point& p : curve.control_points) box.extend(p);
  return std::max(kStandstill * box.diagonal().norm(), kLeastLength);
}

CurveSample circle_sample(double radius, const Eigen::Vector2d& direction) {
  CurveSample sample;
  sample.position = {radius * direction.x(), radius * direction.y(), 0};
  sample.after.tangent = {-direction.y(), direction.x(), 0};
  sample.after.speed = radius;
  sample.after.turn = {-direction.x(), -direction.y(), 0};
  sample.before = sample.after;
  return sample;
}

SampledCurve sample_circle(const SweepCurve& curve) {
  SampledCurve result;
  const auto steps = static_cast<std::size_t>(curve.steps);
  result.samples.reserve(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i) {
    result.samples.push_back(circle_sample(curve.radius, unit_circle_point(i % steps, steps)));
    result.samples.back().arc =
        2 * std::numbers::pi * curve.radius * (static_cast<double>(i) / static_cast<double>(steps));
  }
  result.length = result.samples.back().arc;
  result.planar = result.closed = result.smooth = true;
  return result;
}

// Positions and motions; a joint of two pieces takes its position from the later one, so that it is hit
// exactly.
void fill_samples(const SweepCurve& curve, SampledCurve& result) {
  const std::size_t pieces = curve.pieces(), steps = static_cast<std::size_t>(curve.steps);
  const PieceBasis functions(curve.kind);
  result.standstill = standstill_of(curve);
  for (std::size_t j = 0; j <= steps; ++j) {
    const Basis basis = functions.at(static_cast<double>(j) / static_cast<double>(steps));
    for (std::size_t i = 0; i < pieces; ++i) {
      const Piece piece(curve, i);
      CurveSample& sample = result.samples[i * steps + j];
      if (j < steps || i + 1 == pieces) sample.position = piece.position(basis);
      if (j < steps) sample.after = motion_of(piece, basis, result.standstill, Side::After);
      if (j > 0) sample.before = motion_of(piece, basis, result.standstill, Side::Before);
    }
  }
  result.samples.front().before = result.samples.front().after;
  result.samples.back().after = result.samples.back().before;
}

// Arc lengths step by step, then summed in order.
void fill_arc_lengths(const SweepCurve& curve, SampledCurve& result) {
  const std::size_t pieces = curve.pieces(), steps = static_cast<std::size_t>(curve.steps);
  const double step = 1 / static_cast<double>(curve.steps);
  const PieceBasis functions(curve.kind);
  for (std::size_t j = 0; j < steps; ++j) {
    for (const GaussNode& node : kGauss) {
      const Basis basis = functions.at((static_cast<double>(j) + node.position) * step);
      for (std::size_t i = 0; i < pieces; ++i) {
        const double speed = Piece(curve, i).derivative(basis, 1).norm();
        result.samples[i * steps + j + 1].arc += node.weight * step * speed;
      }
    }
  }
  for (std::size_t i = 1; i < result.samples.size(); ++i) {
    result.samples[i].arc += result.samples[i - 1].arc;
  }
  result.length = result.samples.back().arc;
}

// A piece that is one point takes the tangent of the piece before; at the start, of the one behind.
void fill_unknown_tangents(std::vector<CurveSample>& samples) {
  Motion last;
  const auto fill = [&last](Motion& motion) {
    if (!motion.known()) motion.tangent = last.tangent;
    last = motion;
  };
  for (CurveSample& sample : samples) {
    fill(sample.before);
    fill(sample.after);
  }
  for (auto sample = samples.rbegin(); sample != samples.rend(); ++sample) {
    fill(sample->after);
    fill(sample->before);
  }
}

bool in_plane(const SweepCurve& curve) {
  const auto same_height = [&](const Point& p) { return p.z() == curve.control_points.front().z(); };
  return std::ranges::all_of(curve.control_points, same_height);
}

SampledCurve sample_spline(const SweepCurve& curve) {
  SampledCurve result;
  result.samples.resize(curve.pieces() * static_cast<std::size_t>(curve.steps) + 1);
  fill_samples(curve, result);
  fill_arc_lengths(curve, result);
  fill_unknown_tangents(result.samples);
  result.planar = curve.planar || in_plane(curve);
  return result;
}

}  // namespace

double angle_between(const Vector& a, const Vector& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double CurveSample::turning_angle() const {
  return angle_between(before.tangent, after.tangent);
}

SampledCurve sample_curve(const SweepCurve& curve) {
  const bool circle = curve.kind == SweepCurve::Kind::Circle;
  SampledCurve result = circle ? sample_circle(curve) : sample_spline(curve);
  Box box;
  for (const CurveSample& sample : result.samples) box.extend(sample.position);
  const double least = std::max(kRoundOff * std::max(box.min().norm(), box.max().norm()), kLeastLength);
  result.size = box.diagonal().norm() > least ? box.diagonal().norm() : 0;
  if (circle) return result;
  const CurveSample &first = result.samples.front(), &last = result.samples.back();
  result.closed = (last.position - first.position).norm() <= kSameFraction * result.size;
  result.smooth = result.closed && last.before.tangent.dot(first.after.tangent) > kSameTangent;
  return result;
}

CurveSample sample_at(const SweepCurve& spline, double standstill, double parameter) {
  const double u = parameter / static_cast<double>(spline.steps);
  const std::size_t index = std::min(static_cast<std::size_t>(u), spline.pieces() - 1);
  const Basis basis = PieceBasis(spline.kind).at(u - static_cast<double>(index));
  const Piece piece(spline, index);
  CurveSample sample;
  sample.position = piece.position(basis);
  sample.before = motion_of(piece, basis, standstill, Side::Before);
  sample.after = motion_of(piece, basis, standstill, Side::After);
  return sample;
}

std::vector<std::size_t> distinct_samples(const SampledCurve& curve, bool wraps) {
  std::vector<std::size_t> kept;
  const auto& samples = curve.samples;
  const double least = kSameFraction * curve.size;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!kept.empty() && (samples[i].position - samples[kept.back()].position).norm() <= least) continue;
    kept.push_back(i);
  }
  const auto meets_start = [&] {
    return (samples[kept.back()].position - samples[0].position).norm() <= least;
  };
  while (wraps && kept.size() > 1 && meets_start()) kept.pop_back();
  return kept;
}

std::size_t last_at_point(const SampledCurve& curve, const std::vector<std::size_t>& distinct, std::size_t i,
                          bool wraps) {
  if (i + 1 < distinct.size()) return distinct[i + 1] - 1;
  return wraps ? distinct[i] : curve.samples.size() - 1;
}

Eigen::Vector2d unit_circle_point(std::size_t i, std::size_t n) {
  // The octant, and what is left of it: 8 i = octant * n + rest.
  const std::size_t octant = 8 * i / n, rest = 8 * i % n;
  const bool odd = octant % 2 == 1;
  const double part = static_cast<double>(odd ? n - rest : rest) / static_cast<double>(n);
  const double angle = std::numbers::pi / 4 * part;
  Eigen::Vector2d p(std::cos(angle), std::sin(angle));
  if (odd) std::swap(p.x(), p.y());
  switch (octant / 2) {
    case 1:
      return {-p.y(), p.x()};
    case 2:
      return {-p.x(), -p.y()};
    case 3:
      return {p.y(), -p.x()};
    default:
      return p;
  }
}

}  // namespace meshcontour::detail

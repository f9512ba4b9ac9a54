#include "sweep/beads.hpp"

#include <algorithm>
#include <cmath>

namespace meshcontour::detail {
namespace {

constexpr double kOnAxis = 1e-9;  // of the largest distance from the axis

// The root of f in the bracket [a, b], by false position with the Illinois rule [Dowell & Jarratt 1971,
// doi 10.1007/BF01934364]. f has opposite signs at the ends.
template <class Function>
double bracketed_root(const Function& f, double a, double b) {
  double fa = f(a), fb = f(b);
  double middle = a;
  for (int i = 0; i < 100 && fa != fb; ++i) {
    const double previous = middle;
    middle = std::clamp(b - fb * (b - a) / (fb - fa), std::min(a, b), std::max(a, b));
    const double value = f(middle);
    if (value == 0 || middle == previous) break;
    if ((value > 0) != (fb > 0)) {
      a = b;
      fa = fb;
    } else {
      fa /= 2;
    }
    b = middle;
    fb = value;
  }
  return middle;
}

// The parameter at which the curve crosses the axis, counted in samples.
double crossing_parameter(const SweepCurve& curve, const SampledCurve& samples, double shift,
                          std::size_t from, std::size_t to) {
  const auto x = [&](double g) { return sample_at(curve, samples.standstill, g).position.x() - shift; };
  return bracketed_root(x, static_cast<double>(from), static_cast<double>(to));
}

// Where the profile crosses the axis between two points: on the curve, or on the chord of a circle, which is
// the polygon of its steps.
ProfilePoint crossing(const SweepCurve& curve, const SampledCurve& samples, double shift,
                      const ProfilePoint& from, const ProfilePoint& to, std::size_t to_sample) {
  ProfilePoint point;
  point.sample = from.sample;
  if (curve.kind == SweepCurve::Kind::Circle) {
    const double share = from.position.x() / (from.position.x() - to.position.x());
    point.position = {0, from.position.y() + share * (to.position.y() - from.position.y())};
    point.before = point.after = (to.position - from.position).normalized();
    return point;
  }
  const double parameter = crossing_parameter(curve, samples, shift, from.sample, to_sample);
  const CurveSample sample = sample_at(curve, samples.standstill, parameter);
  point.position = {0, sample.position.y()};
  point.before = sample.before.tangent.head<2>();
  point.after = sample.after.tangent.head<2>();
  return point;
}

bool is_pole(const ProfilePoint& point) {
  return point.position.x() == 0;
}

// Moves the axis to x = 0, and what is next to the axis onto it.
void shift_to_axis(Profile& profile, double shift) {
  double reach = 0;
  for (ProfilePoint& point : profile.points) {
    point.position.x() -= shift;
    reach = std::max(reach, std::abs(point.position.x()));
  }
  for (ProfilePoint& point : profile.points) {
    if (std::abs(point.position.x()) <= kOnAxis * reach) point.position.x() = 0;
  }
}

void insert_crossings(const SweepCurve& curve, const SampledCurve& samples, double shift, Profile& profile) {
  std::vector<ProfilePoint> points;
  const std::size_t count = profile.points.size();
  for (std::size_t i = 0; i < count; ++i) {
    const ProfilePoint& point = profile.points[i];
    points.push_back(point);
    const bool last = i + 1 == count;
    if (last && !profile.closed) break;
    const ProfilePoint& next = profile.points[last ? 0 : i + 1];
    if (point.position.x() * next.position.x() >= 0) continue;
    const std::size_t end = last ? samples.samples.size() - 1 : next.sample;
    points.push_back(crossing(curve, samples, shift, point, next, end));
  }
  profile.points = std::move(points);
}

// A closed profile that meets the axis becomes an open one that starts and ends at the same pole.
void open_at_pole(Profile& profile) {
  const auto pole = std::ranges::find_if(profile.points, is_pole);
  if (!profile.closed || pole == profile.points.end()) return;
  std::rotate(profile.points.begin(), pole, profile.points.end());
  profile.points.push_back(profile.points.front());
  profile.closed = false;
}

}  // namespace

bool Bead::right_of_axis() const {
  return profile.points[first_pole ? 1 : 0].position.x() > 0;
}

std::vector<Bead> split_at_axis(const SweepCurve& curve, const SampledCurve& samples, double shift,
                                double corner_angle) {
  Profile profile = make_profile(samples, corner_angle);
  if (profile.points.size() < (profile.closed ? 3 : 2)) return {};
  shift_to_axis(profile, shift);
  insert_crossings(curve, samples, shift, profile);
  open_at_pole(profile);
  std::vector<Bead> beads;
  const auto& points = profile.points;
  for (std::size_t begin = 0; begin + 1 < points.size();) {
    std::size_t end = begin + 1;
    while (end + 1 < points.size() && !is_pole(points[end])) ++end;
    Bead bead;
    bead.first_pole = is_pole(points[begin]);
    bead.last_pole = is_pole(points[end]);
    bead.profile.closed = profile.closed;
    bead.profile.points.assign(points.begin() + static_cast<std::ptrdiff_t>(begin),
                               points.begin() + static_cast<std::ptrdiff_t>(end) + 1);
    const bool on_axis = bead.first_pole && bead.last_pole && end == begin + 1;
    if (!on_axis) beads.push_back(std::move(bead));
    begin = end;
  }
  return beads;
}

void cap_ends(Bead& bead) {
  if (bead.profile.closed) return;
  auto& points = bead.profile.points;
  const Eigen::Vector2d outwards(bead.right_of_axis() ? 1 : -1, 0);
  const auto axis_point = [](const ProfilePoint& rim, const Eigen::Vector2d& tangent) {
    return ProfilePoint{{0, rim.position.y()}, tangent, tangent, rim.sample};
  };
  if (!bead.first_pole) {
    points.front().before = outwards;
    points.insert(points.begin(), axis_point(points.front(), outwards));
    bead.first_pole = bead.first_cap = true;
  }
  if (!bead.last_pole) {
    points.back().after = -outwards;
    points.push_back(axis_point(points.back(), -outwards));
    bead.last_pole = bead.last_cap = true;
  }
}

bool coincide(const Bead& a, const Bead& b, double distance) {
  const auto &first = a.profile.points, &second = b.profile.points;
  if (first.size() != second.size()) return false;
  const auto same = [distance](const ProfilePoint& p, const ProfilePoint& q) {
    return std::abs(std::abs(p.position.x()) - std::abs(q.position.x())) <= distance &&
           std::abs(p.position.y() - q.position.y()) <= distance;
  };
  return std::equal(first.begin(), first.end(), second.begin(), same) ||
         std::equal(first.begin(), first.end(), second.rbegin(), same);
}

}  // namespace meshcontour::detail

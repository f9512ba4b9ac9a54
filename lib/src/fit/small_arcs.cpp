#include "fit/small_arcs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/arc_fit.hpp"

namespace meshcontour::detail {

namespace {

constexpr std::size_t kFewest = 3;        // arcs on one circle, to believe in any of them
constexpr std::size_t kMostCircles = 32;  // axes that single chords are compared with
constexpr std::size_t kMostCompared = 256;
constexpr std::size_t kMostChordCircles = 256;  // that every single chord is compared with
constexpr double kAlike = 1e-3;                 // by which lengths, radii and axes of like arcs may differ
constexpr double kWiderThanPairs = 1.05;

// A chord in the shell's frame.
struct Chord {
  Point start, end;
};

// A chord's ends as seen from an axis.
struct ChordRing {
  double radius = 0, height = 0, angle = 0;
};

// Like circles have keys that are alike or next to one another.
auto circle_key(const CircularArc& arc) {
  const double grid = 4 * kAlike * arc.radius;
  return std::array{std::round(std::log(arc.radius) / (4 * kAlike)), std::round(arc.center.x() / grid),
                    std::round(arc.center.y() / grid), std::round(arc.center.z() / grid)};
}

bool same_circle(const CircularArc& a, const CircularArc& b) {
  const double slack = kAlike * a.radius;
  return std::abs(a.radius - b.radius) <= slack && (a.center - b.center).norm() <= slack &&
         a.axis.cross(b.axis).norm() <= kAlike;
}

bool is_loose_chord(const Piece& piece) {
  return piece.is_line() && piece.chords() == 1 && !piece.recognized;
}

// Two chords that are one spline, or two lines for want of evidence.
bool is_pair(const std::vector<Piece>& pieces, std::size_t k) {
  if (pieces[k].is_spline()) return pieces[k].chords() == 2;
  return k + 1 < pieces.size() && is_loose_chord(pieces[k]) && is_loose_chord(pieces[k + 1]);
}

void add_pairs(const Recognition& fit, std::vector<CircularArc>& arcs) {
  for (std::size_t k = 0; k < fit.pieces.size(); ++k) {
    if (!is_pair(fit.pieces, k)) continue;
    const std::size_t begin = fit.pieces[k].begin;
    if (fit.pieces[k].is_line()) ++k;
    const double a = fit.path.length[begin], b = fit.path.length[begin + 1];
    if (std::abs(a - b) > kAlike * std::max(a, b)) continue;
    const std::optional<ArcFit> circle = fit_arc(fit.path.run(begin, begin + 2), 1e-6 * a);
    if (!circle) continue;
    arcs.push_back(circle->arc);
    arcs.back().center += fit.path.origin;
    arcs.back().angle /= 2;
  }
}

void add_chords(const Recognition& fit, std::vector<Chord>& chords) {
  for (const Piece& piece : fit.pieces) {
    if (!piece.is_line() || piece.chords() != 1) continue;
    chords.push_back(
        {fit.path.points[piece.begin] + fit.path.origin, fit.path.points[piece.end] + fit.path.origin});
  }
}

// One of each kFewest or more alike, with the widest angle of them.
std::vector<CircularArc> repeated_circles(std::vector<CircularArc> arcs) {
  std::stable_sort(arcs.begin(), arcs.end(),
                   [](const CircularArc& a, const CircularArc& b) { return circle_key(a) < circle_key(b); });
  std::vector<CircularArc> result;
  std::vector<bool> done(arcs.size(), false);
  for (std::size_t i = 0; i < arcs.size() && result.size() < kMostCircles; ++i) {
    if (done[i]) continue;
    CircularArc circle = arcs[i];
    std::size_t count = 1;
    for (std::size_t j = i + 1; j < std::min(arcs.size(), i + kMostCompared); ++j) {
      if (done[j] || !same_circle(circle, arcs[j])) continue;
      done[j] = true;
      circle.angle = std::max(circle.angle, arcs[j].angle);
      ++count;
    }
    if (count >= kFewest) result.push_back(circle);
  }
  return result;
}

std::optional<ChordRing> ring_of(const Chord& chord, const CircularArc& circle) {
  const Vector a = chord.start - circle.center, b = chord.end - circle.center;
  const double ha = a.dot(circle.axis), hb = b.dot(circle.axis);
  const Vector ra = a - ha * circle.axis, rb = b - hb * circle.axis;
  const double slack = 1e-4 * circle.radius;
  if (std::abs(ra.norm() - rb.norm()) > slack || std::abs(ha - hb) > slack) return std::nullopt;
  const double angle = std::atan2(ra.cross(rb).norm(), ra.dot(rb));
  if (!(angle > 0 && angle <= kWiderThanPairs * circle.angle)) return std::nullopt;
  return ChordRing{(ra.norm() + rb.norm()) / 2, (ha + hb) / 2, angle};
}

// Circles about the axis of `circle` that hold kFewest or more of the chords.
void add_chord_circles(const std::vector<Chord>& chords, const CircularArc& circle,
                       std::vector<CircularArc>& result) {
  std::vector<ChordRing> rings;
  for (const Chord& chord : chords) {
    if (const std::optional<ChordRing> ring = ring_of(chord, circle)) rings.push_back(*ring);
  }
  std::sort(rings.begin(), rings.end(), [](const ChordRing& a, const ChordRing& b) {
    return std::array{a.height, a.radius} < std::array{b.height, b.radius};
  });
  const double slack = 1e-4 * circle.radius;
  for (std::size_t i = 0; i < rings.size();) {
    CircularArc found = circle;
    found.center = circle.center + rings[i].height * circle.axis;
    found.radius = rings[i].radius;
    found.angle = 0;
    std::size_t j = i;
    for (; j < rings.size() && rings[j].height - rings[i].height <= slack &&
           std::abs(rings[j].radius - rings[i].radius) <= slack;
         ++j) {
      found.angle = std::max(found.angle, rings[j].angle);
    }
    if (j - i >= kFewest && result.size() < kMostChordCircles) result.push_back(found);
    i = j;
  }
}

}  // namespace

SmallArcs find_small_arcs(const ShellRecognition& shell) {
  std::vector<CircularArc> pairs;
  for (const Recognition& fit : shell.fits) add_pairs(fit, pairs);
  SmallArcs found;
  found.pairs = repeated_circles(std::move(pairs));
  if (found.pairs.empty()) return found;
  std::vector<Chord> chords;
  for (const Recognition& fit : shell.fits) add_chords(fit, chords);
  for (const CircularArc& circle : found.pairs) add_chord_circles(chords, circle, found.chords);
  return found;
}

CircularArc arc_over_chord(const Point& start, const Point& end, const CircularArc& near) {
  const Vector along = (end - start).normalized();
  const Point middle = (start + end) / 2;
  CircularArc arc;
  arc.start = start;
  arc.end = end;
  arc.axis = (near.axis - near.axis.dot(along) * along).normalized();
  arc.center = near.center + (middle - near.center).dot(along) * along;
  arc.center += (middle - arc.center).dot(arc.axis) * arc.axis;
  const Vector a = start - arc.center, b = end - arc.center;
  if (a.cross(b).dot(arc.axis) < 0) arc.axis = -arc.axis;
  arc.radius = a.norm();
  arc.angle = std::atan2(a.cross(b).norm(), a.dot(b));
  return arc;
}

bool is_chord_of(const Point& start, const Point& end, const CircularArc& circle, double slack) {
  if (distance_to_circle(circle, start) > slack || distance_to_circle(circle, end) > slack) return false;
  const Vector a = start - circle.center, b = end - circle.center;
  return std::atan2(a.cross(b).norm(), a.dot(b)) <= kWiderThanPairs * circle.angle;
}

}  // namespace meshcontour::detail

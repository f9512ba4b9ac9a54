#include "fit/piece.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fit/arc_fit.hpp"
#include "fit/ellipse_fit.hpp"

namespace meshcontour::detail {

namespace {

constexpr std::size_t kShortestLine = 2;  // chords
constexpr std::size_t kShortestArc = 3;
constexpr std::size_t kMostMoved = 4;  // chords from one piece to the next

std::optional<Piece> try_line(const Path& path, std::size_t begin, std::size_t end, double eps) {
  const std::optional<double> residual = line_residual(path.run(begin, end), eps);
  if (!residual) return std::nullopt;
  Piece piece = line_piece(path, begin, end);
  piece.residual = *residual;
  return piece;
}

std::optional<Piece> try_arc(const Path& path, std::size_t begin, std::size_t end, double eps) {
  const std::optional<ArcFit> fit = fit_arc(path.run(begin, end), eps);
  if (!fit) return std::nullopt;
  return Piece{begin, end, fit->arc, fit->residual, false};
}

// The longest piece from `begin` that the attempt accepts: the length is doubled until it fails, then
// bisected.
template <class Attempt>
std::optional<Piece> longest(std::size_t begin, std::size_t end, std::size_t shortest, Attempt attempt) {
  if (begin + shortest > end) return std::nullopt;
  std::optional<Piece> best = attempt(begin + shortest);
  if (!best) return std::nullopt;
  std::size_t good = begin + shortest, bad = end + 1;
  while (bad > good + 1) {
    const std::size_t doubled = begin + 2 * (good - begin);
    const std::size_t next = bad == end + 1 ? std::min(doubled, end) : good + (bad - good) / 2;
    if (std::optional<Piece> piece = attempt(next)) {
      best = std::move(piece);
      good = next;
    } else {
      bad = next;
    }
  }
  return best;
}

// Twice the length within eps of a line is four times as deep, which may be enough to tell an arc from it;
// else two more doublings are.
std::optional<Piece> longest_arc(const Path& path, std::size_t begin, std::size_t end, std::size_t straight,
                                 double eps) {
  const auto attempt = [&](std::size_t j) { return try_arc(path, begin, j, eps); };
  std::size_t shortest = std::max(kShortestArc, 2 * straight);
  std::optional<Piece> arc = longest(begin, end, shortest, attempt);
  for (int doubling = 0; doubling < 2 && !arc && straight > 1; ++doubling) {
    shortest *= 2;
    arc = longest(begin, end, shortest, attempt);
  }
  return arc;
}

std::vector<Piece> greedy(const Path& path, std::size_t begin, std::size_t end, double eps, bool arcs) {
  std::vector<Piece> pieces;
  for (std::size_t i = begin; i < end;) {
    const auto line =
        longest(i, end, kShortestLine, [&](std::size_t j) { return try_line(path, i, j, eps); });
    const auto arc = arcs ? longest_arc(path, i, end, line ? line->chords() : 0, eps) : std::nullopt;
    if (arc && (!line || arc->end > line->end)) {
      pieces.push_back(*arc);
    } else {
      pieces.push_back(line ? *line : line_piece(path, i, i + 1));
    }
    i = pieces.back().end;
  }
  return pieces;
}

// Whether a chord at the end of an arc is no part of it: its length is off the even ones between, and its far
// point off the arc through the others, or, where noise hides that, the path goes on in steps like the
// chord's.
bool is_foreign(const Path& path, const Piece& arc, bool at_end, double eps, std::optional<Piece>& rest) {
  if (arc.chords() < kShortestArc + 1) return false;
  const std::size_t begin = arc.begin + (at_end ? 0 : 1), end = arc.end - (at_end ? 1 : 0);
  const double own = path.length[at_end ? arc.end - 1 : arc.begin];
  const double slack = 0.1 + 5 * unevenness(path, begin, end);
  const double next = path.length[at_end ? end - 1 : begin];
  if (!(std::abs(own / next - 1) > slack)) return false;
  rest = try_arc(path, begin, end, eps);
  if (!rest) return false;
  const double off =
      distance_to_circle(std::get<CircularArc>(rest->curve), path.points[at_end ? arc.end : arc.begin]);
  if (off > 3 * rest->residual + 1e-3 * eps) return true;
  const std::size_t beyond = at_end ? arc.end : arc.begin - 1;
  const bool known = at_end ? arc.end < path.chords() : arc.begin > 0;
  return known && rest->residual > 0.1 * eps && std::abs(path.length[beyond] / own - 1) < slack;
}

std::vector<Piece> give_away_foreign_ends(const Path& path, const std::vector<Piece>& pieces, double eps) {
  std::vector<Piece> result;
  for (const Piece& piece : pieces) {
    if (!piece.is_arc()) {
      result.push_back(piece);
      continue;
    }
    Piece arc = piece;
    std::vector<Piece> behind;
    std::optional<Piece> rest;
    for (std::size_t k = 0; k < kMostMoved && is_foreign(path, arc, false, eps, rest); ++k) {
      result.push_back(line_piece(path, arc.begin, arc.begin + 1));
      arc = *rest;
    }
    for (std::size_t k = 0; k < kMostMoved && is_foreign(path, arc, true, eps, rest); ++k) {
      behind.push_back(line_piece(path, arc.end - 1, arc.end));
      arc = *rest;
    }
    result.push_back(arc);
    result.insert(result.end(), behind.rbegin(), behind.rend());
  }
  return result;
}

bool is_short_line(const Piece& piece) {
  return piece.is_line() && piece.chords() <= kMostMoved;
}

// Two neighbours as one: an arc and a few chords that are steps of it, or two pieces of the same kind, which
// noise may have cut apart.
std::optional<Piece> joined(const Path& path, const Piece& a, const Piece& b, const GrowLimits& limits) {
  std::optional<Piece> rest;
  if (a.is_arc() || b.is_arc()) {
    if (!a.is_arc() && !is_short_line(a)) return std::nullopt;
    if (!b.is_arc() && !is_short_line(b)) return std::nullopt;
    std::optional<Piece> arc = try_arc(path, a.begin, b.end, limits.joined);
    if (!arc || (!a.is_arc() && is_foreign(path, *arc, false, limits.eps, rest))) return std::nullopt;
    return !b.is_arc() && is_foreign(path, *arc, true, limits.eps, rest) ? std::nullopt : arc;
  }
  if (a.chords() == 1 || b.chords() == 1) return std::nullopt;
  return try_line(path, a.begin, b.end, limits.joined);
}

// Joins neighbours, at most kMostMoved times for each piece that results, which keeps it linear.
std::vector<Piece> join_neighbours(const Path& path, const std::vector<Piece>& pieces,
                                   const GrowLimits& limits) {
  std::vector<Piece> result;
  std::vector<std::size_t> joins;
  for (Piece piece : pieces) {
    std::size_t own = 0;
    while (!result.empty() && own + joins.back() < kMostMoved) {
      std::optional<Piece> both = joined(path, result.back(), piece, limits);
      if (!both) break;
      piece = std::move(*both);
      own += joins.back() + 1;
      result.pop_back();
      joins.pop_back();
    }
    result.push_back(std::move(piece));
    joins.push_back(own);
  }
  return result;
}

// The chord of a line next to an arc, when it is a step like the arc's own and the line has longer ones:
// noise hides where the line begins, lengths do not. The two pieces with their joint moved by that chord.
bool settle_joint(const Path& path, Piece& before, Piece& after, const GrowLimits& limits) {
  if (before.is_arc() == after.is_arc()) return false;
  const Piece& line = before.is_arc() ? after : before;
  const Piece& arc = before.is_arc() ? before : after;
  if (!line.is_line() || line.chords() < 2) return false;
  const double beside = path.length[before.is_arc() ? line.begin : line.end - 1];
  const double step = path.length[before.is_arc() ? arc.end - 1 : arc.begin];
  const auto first = path.length.begin() + static_cast<std::ptrdiff_t>(line.begin);
  const double longest = *std::max_element(first, first + static_cast<std::ptrdiff_t>(line.chords()));
  if (std::abs(beside / step - 1) > 0.1 || longest < 2 * beside) return false;
  const std::size_t joint = before.is_arc() ? before.end + 1 : before.end - 1;
  std::optional<Piece> grown = before.is_arc() ? try_arc(path, before.begin, joint, limits.joined)
                                               : try_arc(path, joint, after.end, limits.joined);
  const std::size_t begin = before.is_arc() ? joint : line.begin, end = before.is_arc() ? line.end : joint;
  std::optional<Piece> rest = try_line(path, begin, end, limits.joined);
  if (!grown || !rest) return false;
  (grown->begin < rest->begin ? before : after) = *grown;
  (grown->begin < rest->begin ? after : before) = *rest;
  return true;
}

void settle_joints(const Path& path, std::vector<Piece>& pieces, const GrowLimits& limits) {
  for (std::size_t k = 0; k + 1 < pieces.size(); ++k) {
    for (std::size_t moved = 0; moved < kMostMoved; ++moved) {
      if (!settle_joint(path, pieces[k], pieces[k + 1], limits)) break;
    }
  }
}

}  // namespace

Piece line_piece(const Path& path, std::size_t begin, std::size_t end) {
  return {begin, end, LineSegment{path.points[begin], path.points[end]}, 0, false};
}

Vector tangent_of(const Piece& piece, bool at_end) {
  if (const auto* line = std::get_if<LineSegment>(&piece.curve))
    return (line->end - line->start).normalized();
  if (const auto* ellipse = std::get_if<EllipticalArc>(&piece.curve)) {
    const double t = ellipse_parameter(*ellipse, at_end ? ellipse->end : ellipse->start);
    const Vector minor = ellipse->ratio * ellipse->axis.cross(ellipse->major);
    return (std::cos(t) * minor - std::sin(t) * ellipse->major).normalized();
  }
  if (const auto* spline = std::get_if<BSplineCurve>(&piece.curve)) {
    const auto [begin, end] = spline->domain();
    return derivatives(*spline, at_end ? end : begin, 1).row(1).transpose().normalized();
  }
  const auto& arc = std::get<CircularArc>(piece.curve);
  return arc.axis.cross((at_end ? arc.end : arc.start) - arc.center).normalized();
}

double unevenness(const Path& path, std::size_t begin, std::size_t end) {
  const auto [smallest, largest] =
      std::minmax_element(path.length.begin() + static_cast<std::ptrdiff_t>(begin),
                          path.length.begin() + static_cast<std::ptrdiff_t>(end));
  return *largest / *smallest - 1;
}

std::vector<Piece> grow_pieces(const Path& path, std::size_t begin, std::size_t end,
                               const GrowLimits& limits) {
  std::vector<Piece> pieces =
      join_neighbours(path, greedy(path, begin, end, limits.eps, limits.arcs), limits);
  pieces = give_away_foreign_ends(path, pieces, limits.eps);
  pieces = join_neighbours(path, pieces, limits);
  settle_joints(path, pieces, limits);
  return pieces;
}

}  // namespace meshcontour::detail

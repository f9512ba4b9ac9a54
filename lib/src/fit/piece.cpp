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

std::vector<Piece> greedy(const Path& path, std::size_t begin, std::size_t end, double eps, bool arcs) {
  std::vector<Piece> pieces;
  for (std::size_t i = begin; i < end;) {
    const auto line =
        longest(i, end, kShortestLine, [&](std::size_t j) { return try_line(path, i, j, eps); });
    const auto arc =
        !arcs ? std::nullopt
              : longest(i, end, kShortestArc, [&](std::size_t j) { return try_arc(path, i, j, eps); });
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
// point is off the arc through the others.
bool is_foreign(const Path& path, const Piece& arc, bool at_end, double eps, std::optional<Piece>& rest) {
  if (arc.chords() < kShortestArc + 1) return false;
  const std::size_t begin = arc.begin + (at_end ? 0 : 1), end = arc.end - (at_end ? 1 : 0);
  const double own = path.length[at_end ? arc.end - 1 : arc.begin];
  const double even = unevenness(path, begin, end);
  const double next = path.length[at_end ? end - 1 : begin];
  if (!(std::abs(own / next - 1) > 0.1 + 5 * even)) return false;
  rest = try_arc(path, begin, end, eps);
  if (!rest) return false;
  const double off =
      distance_to_circle(std::get<CircularArc>(rest->curve), path.points[at_end ? arc.end : arc.begin]);
  return off > 3 * rest->residual + 1e-3 * eps;
}

std::vector<Piece> give_away_foreign_ends(const Path& path, std::vector<Piece> pieces, double eps) {
  std::vector<Piece> result;
  for (const Piece& piece : pieces) {
    if (!piece.is_arc()) {
      result.push_back(piece);
      continue;
    }
    Piece arc = piece;
    std::vector<Piece> behind;
    std::optional<Piece> rest;
    while (is_foreign(path, arc, false, eps, rest)) {
      result.push_back(line_piece(path, arc.begin, arc.begin + 1));
      arc = *rest;
    }
    while (is_foreign(path, arc, true, eps, rest)) {
      behind.push_back(line_piece(path, arc.end - 1, arc.end));
      arc = *rest;
    }
    result.push_back(arc);
    result.insert(result.end(), behind.rbegin(), behind.rend());
  }
  return result;
}

// Arcs take in single chords before them, and neighbours that are the same line or arc become one.
std::vector<Piece> join_neighbours(const Path& path, const std::vector<Piece>& pieces, double eps) {
  std::vector<Piece> result;
  for (Piece piece : pieces) {
    while (!result.empty()) {
      const Piece& before = result.back();
      const bool chord = before.is_line() && before.chords() == 1;
      const bool same_kind = before.is_arc() == piece.is_arc() && before.chords() > 1 && piece.chords() > 1;
      if (!(piece.is_arc() && chord) && !same_kind) break;
      const std::optional<Piece> joined = piece.is_arc() ? try_arc(path, before.begin, piece.end, eps)
                                                         : try_line(path, before.begin, piece.end, eps);
      if (!joined) break;
      piece = *joined;
      result.pop_back();
    }
    result.push_back(piece);
  }
  return result;
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

std::vector<Piece> grow_pieces(const Path& path, std::size_t begin, std::size_t end, double eps, bool arcs) {
  std::vector<Piece> pieces = join_neighbours(path, greedy(path, begin, end, eps, arcs), eps);
  return give_away_foreign_ends(path, std::move(pieces), eps);
}

}  // namespace meshcontour::detail

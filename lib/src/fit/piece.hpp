#pragma once

#include <cstddef>
#include <vector>

#include "fit/path.hpp"
#include "meshcontour/curve.hpp"

namespace meshcontour::detail {

/// Points begin .. end of a path as one curve, in the path's own frame.
struct Piece {
  std::size_t begin = 0, end = 0;
  Curve curve = LineSegment{};
  double residual = 0;      ///< largest distance of a point to the curve
  bool recognized = false;  ///< a line, arc or ellipse for which there is evidence
  double deviation = -1;    ///< of a B-spline, its bound to the chords; negative: follows from the residual

  std::size_t chords() const { return end - begin; }
  bool is_line() const { return std::holds_alternative<LineSegment>(curve); }
  bool is_arc() const { return std::holds_alternative<CircularArc>(curve); }
  bool is_spline() const { return std::holds_alternative<BSplineCurve>(curve); }
};

/// The chord from one point to another as a piece.
Piece line_piece(const Path& path, std::size_t begin, std::size_t end);

/// Direction of travel at the start or end, of length 1.
Vector tangent_of(const Piece& piece, bool at_end);

/// Largest over smallest chord of a run, minus 1.
double unevenness(const Path& path, std::size_t begin, std::size_t end);

/// How far points may be off the pieces that are grown over them, model units.
struct GrowLimits {
  double eps = 0;     ///< of one piece
  double joined = 0;  ///< of pieces that are joined, at least eps: noise may have cut them apart
  bool arcs = true;   ///< false: lines only
};

/// Greedy split of the points begin .. end into maximal lines (over two or more chords), maximal arcs (over
/// three or more) and single chords; lengths are found by doubling and bisection. Arcs then take in the few
/// chords beside them that are steps like their own, give away end chords that are not, and join with equal
/// neighbours. Nothing is `recognized` yet. O(N log N).
std::vector<Piece> grow_pieces(const Path& path, std::size_t begin, std::size_t end,
                               const GrowLimits& limits);

}  // namespace meshcontour::detail

#pragma once

// One loop on its way to a contour, as every method sees it.

#include <cstddef>
#include <span>

#include "fit/cleaning.hpp"
#include "meshcontour/boundary.hpp"
#include "meshcontour/curve.hpp"

namespace meshcontour::detail {

/// A loop's distinct points, and which vertices of the shell they are.
struct Loop {
  CleanedPoints cleaned;
  std::vector<Index> vertices;  ///< of the shell, one a cleaned point
  bool closed = true;
};

Loop make_loop(std::span<const Point> shell_points, const BoundaryLoop& boundary);

/// Why a loop cannot become anything but its polygon.
enum class LoopDefect {
  None,
  TooFewPoints,  ///< fewer than 3 distinct points, or 2 in an open chain
  OutOfRange,    ///< so large or so small that squares of its lengths are not numbers
};

LoopDefect find_defect(const Loop& loop);

/// Whether the fourth powers of lengths of this size are numbers; 0 is.
bool is_usable_size(double diagonal);

/// The loop's own polygon as line segments; of a single point, one segment without length. Marked as a
/// fallback.
Contour polygon_contour(const Loop& loop);

}  // namespace meshcontour::detail

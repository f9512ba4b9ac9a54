#pragma once

#include <cstddef>

#include "meshcontour/model.hpp"

namespace meshcontour::detail {

/// The shell after edge collapses in the order of their quadric errors.
///
/// Inner vertices go where the error is least; vertices of sharp edges stay, or go to one of their neighbours
/// along the edges. No triangle turns by more than about 80 degrees. [Garland & Heckbert 1997; borders as
/// there, section 6]
///
/// @param triangles  to stop at.
/// @param limit      largest root mean square distance of a vertex to the planes that it stands for;
/// infinity: none.
/// @param keep_sharp  vertices of sharp edges all stay.
Shell collapsed(const Shell& shell, std::size_t triangles, double limit, unsigned threads,
                bool keep_sharp = false);

}  // namespace meshcontour::detail

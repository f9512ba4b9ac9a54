#pragma once

#include <cstddef>

#include "meshcontour/model.hpp"
#include "model/adjacency.hpp"

namespace meshcontour::detail {

/// Points, not on an edge of three or more triangles, whose triangles form more than one fan. No triangle may
/// name a point twice.
std::size_t count_bow_ties(const Shell& shell, const Adjacency& adjacency, unsigned threads);

/// Gives every fan a point of its own: the first fan of a point, by triangle, keeps it, the others get copies
/// at the end of the points. Triangles are in one fan where an edge of theirs at the point has two triangles
/// that run opposite ways. Returns the number of copies.
std::size_t split_fans(Shell& shell, const Adjacency& adjacency);

}  // namespace meshcontour::detail

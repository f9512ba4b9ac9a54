#pragma once

#include <cstdint>
#include <vector>

#include "meshcontour/model.hpp"
#include "model/adjacency.hpp"

namespace meshcontour::detail {

/// One a side: 1 when its edge has exactly two triangles, whose planes meet at less than the angle, by 1e-4
/// at least.
std::vector<std::uint8_t> smooth_sides(const Shell& shell, const Adjacency& adjacency, double radians,
                                       unsigned threads);

}  // namespace meshcontour::detail

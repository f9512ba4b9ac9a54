#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshcontour/model.hpp"
#include "model/adjacency.hpp"

namespace meshcontour::detail {

/// How a component that cannot be oriented is treated.
enum class Unorientable {
  Keep,  ///< its triangles stay as they are
  Turn,  ///< as its triangles are reached from the first one; some edges still join two that run the same way
};

struct OrientationCounts {
  std::size_t turned = 0;        ///< triangles
  std::size_t unorientable = 0;  ///< components
};

/// Makes the triangles of each component run the same way; `adjacency` and the corner normals follow.
OrientationCounts orient_components(Shell& shell, Adjacency& adjacency, Unorientable unorientable);

}  // namespace meshcontour::detail

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "meshcontour/model.hpp"

namespace bench {

/// A mesh with subdivision connectivity; made when it is asked for.
struct SubdividedMesh {
  std::string name;
  std::function<meshcontour::Shell()> make;
};

/// Smooth and detailed, closed and open surfaces of 30 to 110 thousand triangles, one patch each.
std::vector<SubdividedMesh> subdivided_meshes();

/// Any closed or open mesh on a base mesh of so many triangles, halved `levels` times: edges are collapsed,
/// and what is subdivided is put on the nearest point of the mesh.
meshcontour::Shell projected(const meshcontour::Shell& shell, std::size_t base, unsigned levels);

}  // namespace bench

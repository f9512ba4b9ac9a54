#pragma once

#include <functional>
#include <span>

#include "meshcontour/model.hpp"
#include "meshcontour/read.hpp"

namespace meshcontour::detail {

/// The faces of a control mesh, with what is needed to say where one stands.
struct NetFaces {
  Polygons polygons;
  std::vector<std::size_t> offsets;  ///< of each face in the file

  std::size_t size() const { return polygons.sizes.size(); }
};

/// Checks what a control mesh must be: corners of a face differ, no two faces are equal, and the fans of
/// triangles form an oriented manifold. Its inner points have three edges or more then: two would be those of
/// equal faces. Linear but for sorts of the faces and of the edges at each point.
///
/// @param triangles  the fans of the faces, in their order.
/// @param fail       called with a face and what is wrong; does not return.
void check_net(const NetFaces& faces, std::span<const Triangle> triangles, std::size_t points,
               const ReadOptions& options, const std::function<void(std::size_t, const std::string&)>& fail);

/// Faces that fold when they are cut into a fan: a triangle faces against the area vector of the whole.
std::vector<std::size_t> folded_faces(const NetFaces& faces, std::span<const Point> points);

}  // namespace meshcontour::detail

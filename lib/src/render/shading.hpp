#pragma once

#include <span>

#include "render/scene.hpp"

namespace meshcontour::detail {

/// A vertex in the colour that it has in the picture. One layout for faces, lines and points: another would
/// have the rasterizer compile further programs.
struct ShadedVertex {
  std::array<float, 3> position;
  std::array<float, 4> color;  ///< 0 to 1
};

/// Light on the faces of one placement: from over the viewer's left shoulder, ambient 0.36, diffuse 0.64, on
/// the side of a face that is seen. Done here, as the rasterizer would compile a program for it that takes as
/// long as a small picture.
class FaceLight {
 public:
  /// @param perspective  of the picture; else faces are all seen along the eye's z axis.
  FaceLight(const Placement& placement, bool perspective);

  /// Three vertices a triangle.
  void shade(std::span<const Vertex> corners, std::span<ShadedVertex> shaded) const;

 private:
  bool seen_from_front(const Vertex* corners) const;
  float intensity(const Vertex& corner, bool front) const;

  Eigen::Matrix3f linear_, normals_;  // local to eye: points, and normals times any positive number
  Eigen::Vector3f shift_;
  bool perspective_;
};

/// Vertices in their own colours.
void keep_colors(std::span<const Vertex> vertices, std::span<ShadedVertex> shaded);

}  // namespace meshcontour::detail

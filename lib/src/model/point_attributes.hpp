#pragma once

#include <cstddef>

#include "meshcontour/model.hpp"

namespace meshcontour::detail {

/// Gives a point the colour and the texture coordinates of another, where the shell has them.
inline void copy_point_attributes(Shell& shell, std::size_t from, std::size_t to) {
  if (!shell.point_colors.empty()) shell.point_colors[to] = Eigen::Vector4d(shell.point_colors[from]);
  if (!shell.texture_coordinates.empty()) {
    shell.texture_coordinates[to] = Eigen::Vector2d(shell.texture_coordinates[from]);
  }
}

/// As many colours and texture coordinates as points, where the shell has them; new ones are zero.
inline void resize_point_attributes(Shell& shell) {
  if (!shell.point_colors.empty()) shell.point_colors.resize(shell.points.size(), Eigen::Vector4d::Zero());
  if (!shell.texture_coordinates.empty()) {
    shell.texture_coordinates.resize(shell.points.size(), Eigen::Vector2d::Zero());
  }
}

}  // namespace meshcontour::detail

#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>

namespace meshcontour {

using Point = Eigen::Vector3d;
using Vector = Eigen::Vector3d;
using Index = std::uint32_t;
using Triangle =
    std::array<Index, 3>;  ///< three indices into Shell::points, counter-clockwise seen from outside
using Box = Eigen::AlignedBox3d;

/// Colour with 8 bits a channel; alpha 255 is opaque.
struct Rgba {
  std::uint8_t red = 0x7d, green = 0x7d, blue = 0x7d, alpha = 0xff;
  friend bool operator==(const Rgba&, const Rgba&) = default;
};

}  // namespace meshcontour

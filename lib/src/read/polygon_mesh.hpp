#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/large_array.hpp"
#include "meshcontour/model.hpp"
#include "read/format.hpp"

namespace meshcontour::detail {

/// Collects the points and polygons of a mesh file and makes a clean model of them.
///
/// Indices are checked by the reader, which knows the line; everything else is checked here.
class PolygonMesh {
 public:
  /// Triangles that a file puts together: a patch, if there is more than one.
  struct Group {
    std::string name;
    Rgba color;
  };

  explicit PolygonMesh(const ReadContext& context);

  std::vector<Point> points;
  std::vector<Vector> normals;                       ///< that corners may name; of any length
  std::vector<Group> groups;                         ///< that polygons may name
  std::vector<Eigen::Vector4d> point_colors;         ///< one a point, or none; as in Shell
  std::vector<Eigen::Vector2d> texture_coordinates;  ///< the same

  /// Adds a polygon as triangles; one with fewer than three corners is left out and counted.
  ///
  /// @param corners         indices into points.
  /// @param corner_normals  indices into normals, parallel to corners; or empty.
  /// @param group           index into groups; 0 where there are none.
  /// @throws Error          OutOfMemory when there are more triangles than the options allow.
  void add_polygon(std::span<const Index> corners, std::span<const Index> corner_normals = {},
                   Index group = 0);

  /// Adds a triangle; as above.
  void add_triangle(const Triangle& triangle, Index group = 0);

  /// Room for triangles of which the file is known to hold the bytes.
  void reserve_triangles(std::size_t count) { reserve_large(shell_.triangles, count); }

  /// Counts something that was mended or left out.
  void note(Diagnostic::Severity severity, const std::string& message, const Spot& spot = {},
            std::size_t count = 1);

  /// Patches from the groups, points welded where the options ask for it, the mesh cleaned.
  Model finish() &&;

 private:
  void make_patches();
  void weld();

  const ReadContext& context_;
  Shell shell_;
  std::vector<Index> triangle_groups_;             // empty while all are of group 0
  std::vector<std::array<std::uint32_t, 3>> cut_;  // scratch
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace meshcontour::detail

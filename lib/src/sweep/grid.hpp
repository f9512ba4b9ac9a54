#pragma once

// Turns a grid of rings and columns into points, triangles, patches and corner normals of a shell.

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "meshcontour/parallel.hpp"
#include "sweep/profile.hpp"

namespace meshcontour::detail {

/// Which side of a ring or column a normal belongs to.
enum class Side { Before, After };

/// Rings along the sweep, columns along the profile. The first and last column may be poles: one point for
/// all rings.
struct Grid {
  std::size_t rings = 0, columns = 0;  ///< poles are columns
  bool rings_wrap = false, columns_wrap = false;
  bool first_pole = false, last_pole = false;
  bool flip = false;     ///< the other side is outside
  std::size_t base = 0;  ///< index of the first point

  std::size_t strips() const { return rings_wrap ? rings : rings - 1; }
  std::size_t spans() const { return columns_wrap ? columns : columns - 1; }
  std::size_t point_count() const;
  bool is_pole(std::size_t column) const;
  /// Index of a point; both arguments are taken modulo their number. Poles lie before and behind all rings.
  Index point(std::size_t ring, std::size_t column) const;
};

/// A part of a grid that becomes one patch.
struct Region {
  Range strips, spans;
  std::string name;
};

/// The triangles of a cell, one or two (at a pole). A corner is 0 or 1 on the nearer ring, 2 or 3 on the
/// farther one, even in the nearer column.
struct CellTriangles {
  std::array<std::array<std::size_t, 3>, 2> corners;
  std::size_t first = 0, last = 2;  ///< which of the two there are
};
CellTriangles cell_triangles(const Grid& grid, std::size_t span);

/// Triangles in one strip of a region.
std::size_t triangles_in_strip(const Grid& grid, const Region& region);

/// Appends the triangles and patches of the regions: by region, strip and span.
void append_triangles(const Grid& grid, const std::vector<Region>& regions, unsigned threads, Shell& shell);

/// Reverses the triangles from the given one on.
void flip_triangles(Shell& shell, std::size_t first_triangle);

/// Six times the signed volume of the triangles from the given one on; it means something only if they are
/// closed.
double signed_volume(const Shell& shell, std::size_t first_triangle);

/// The analytic normal where it agrees with the triangle, else the triangle's own.
Vector agreeing_normal(const Vector& normal, const Vector& area_vector);

/// Rings that one task takes, so that it has some ten thousand cells.
inline std::size_t grain_of(std::size_t width) {
  return 1 + 16384 / (width + 1);
}

/// Appends the points; position(ring, column).
template <class Position>
void append_points(const Grid& grid, const Position& position, unsigned threads, Shell& shell) {
  shell.points.resize(grid.base + grid.point_count());
  parallel_for(grid.rings, grain_of(grid.columns), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t ring = begin; ring < end; ++ring) {
      for (std::size_t column = 0; column < grid.columns; ++column) {
        if (grid.is_pole(column) && ring > 0) continue;
        shell.points[grid.point(ring, column)] = position(ring, column);
      }
    }
  });
}

/// Fills the corner normals of one strip, whose triangles start at `triangle`.
template <class Normal>
void fill_strip_normals(const Grid& grid, std::size_t strip, const Range& spans, const Normal& normal,
                        std::size_t triangle, Shell& shell) {
  for (std::size_t span = spans.begin; span < spans.end; ++span) {
    std::array<Vector, 4> normals;
    for (std::size_t i = 0; i < 4; ++i) {
      normals[i] = normal((strip + i / 2) % grid.rings, i / 2 == 0 ? Side::After : Side::Before,
                          (span + i % 2) % grid.columns, i % 2 == 0 ? Side::After : Side::Before);
      if (grid.flip) normals[i] = -normals[i];
    }
    const CellTriangles cell = cell_triangles(grid, span);
    for (std::size_t k = cell.first; k < cell.last; ++k, ++triangle) {
      const auto& [a, b, c] = shell.triangles[triangle];
      const Vector area = (shell.points[b] - shell.points[a]).cross(shell.points[c] - shell.points[a]);
      for (std::size_t i = 0; i < 3; ++i) {
        shell.corner_normals[3 * triangle + i] = agreeing_normal(normals[cell.corners[k][i]], area);
      }
    }
  }
}

/// Fills the corner normals of regions whose triangles start at `triangle`.
///
/// normal(ring, side of the ring, column, side of the column): for the grid that is not flipped; zero where
/// unknown.
template <class Normal>
void append_normals(const Grid& grid, const std::vector<Region>& regions, const Normal& normal,
                    std::size_t triangle, unsigned threads, Shell& shell) {
  shell.corner_normals.resize(3 * shell.triangles.size());
  for (const Region& region : regions) {
    const std::size_t row = triangles_in_strip(grid, region), strips = region.strips.size();
    parallel_for(strips, grain_of(row), threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        fill_strip_normals(grid, region.strips.begin + i, region.spans, normal, triangle + i * row, shell);
      }
    });
    triangle += row * strips;
  }
}

}  // namespace meshcontour::detail

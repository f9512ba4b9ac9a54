#pragma once

// Turns a grid of rings and columns into points, triangles, patches and corner normals of a shell.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/large_pages.hpp"
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
  /// Columns other than poles.
  std::size_t body_columns() const { return columns - (first_pole ? 1 : 0) - (last_pole ? 1 : 0); }
  std::size_t point_count() const { return rings * body_columns() + (columns - body_columns()); }
  bool is_pole(std::size_t column) const {
    return (first_pole && column == 0) || (last_pole && column + 1 == columns);
  }
  std::size_t next_ring(std::size_t ring) const { return ring + 1 == rings ? 0 : ring + 1; }
  std::size_t next_column(std::size_t column) const { return column + 1 == columns ? 0 : column + 1; }

  /// Index of a point. Poles lie before and behind all rings.
  Index point(std::size_t ring, std::size_t column) const {
    if (first_pole && column == 0) return static_cast<Index>(base);
    if (last_pole && column + 1 == columns) return static_cast<Index>(base + point_count() - 1);
    const std::size_t poles_before = first_pole ? 1 : 0;
    return static_cast<Index>(base + poles_before + ring * body_columns() + column - poles_before);
  }
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

/// The triangles of the cell that starts at a column.
inline CellTriangles cell_triangles(const Grid& grid, std::size_t column) {
  CellTriangles cell{{{{0, 1, 2}, {2, 1, 3}}}};
  if (grid.flip) cell.corners = {{{0, 2, 1}, {2, 3, 1}}};
  if (grid.is_pole(column)) cell.first = 1;
  if (grid.is_pole(grid.next_column(column))) cell.last = 1;
  return cell;
}

/// Triangles in one strip of a region.
std::size_t triangles_in_strip(const Grid& grid, const Range& spans);

/// Appends the triangles and patches of the regions: by region, strip and span.
void append_triangles(const Grid& grid, const std::vector<Region>& regions, unsigned threads, Shell& shell);

/// Reverses the triangles from the given one on.
void flip_triangles(Shell& shell, std::size_t first_triangle);

/// Six times the signed volume of the triangles from the given one on; it means something only if they are
/// closed.
double signed_volume(const Shell& shell, std::size_t first_triangle);

/// The analytic normal where it agrees with the triangle, else the triangle's own.
inline Vector agreeing_normal(const Vector& normal, const Vector& area_vector) {
  if (normal.dot(area_vector) > 0 || area_vector == Vector::Zero()) return normal;
  return area_vector.stableNormalized();
}

/// Makes room for `size` elements in all.
template <class Element>
void grow(std::vector<Element>& elements, std::size_t size) {
  if (size > elements.capacity()) {
    elements.reserve(std::max(size, 2 * elements.capacity()));
    advise_large_pages(elements.data(), elements.capacity() * sizeof(Element));
  }
  elements.resize(size);
}

/// Rings that one task takes, so that it has some ten thousand cells.
inline std::size_t grain_of(std::size_t width) {
  return 1 + 16384 / (width + 1);
}

/// Appends the points; position(ring, column).
template <class Position>
void append_points(const Grid& grid, const Position& position, unsigned threads, Shell& shell) {
  grow(shell.points, grid.base + grid.point_count());
  parallel_for(grid.rings, grain_of(grid.columns), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t ring = begin; ring < end; ++ring) {
      for (std::size_t column = 0; column < grid.columns; ++column) {
        if (grid.is_pole(column) && ring > 0) continue;
        shell.points[grid.point(ring, column)] = position(ring, column);
      }
    }
  });
}

/// The normals along a part of a ring, on one side of it: those before and after the first column, the
/// second, and so on. They are those of a grid that is not flipped; zero where unknown.
using RowOfNormals = std::vector<Vector>;

/// Fills the corner normals of one strip, whose triangles start at `triangle`; near and far are those of its
/// rings.
void fill_strip_normals(const Grid& grid, const Range& spans, const RowOfNormals& near,
                        const RowOfNormals& far, std::size_t triangle, Shell& shell);

/// Fills the corner normals of regions whose triangles start at `triangle`.
///
/// normals.at(ring, side of the ring, column, side of the column) is a normal; normals.smooth(ring) and
/// normals.smooth_column(column) tell if both sides have the same.
template <class Normals>
void append_normals(const Grid& grid, const std::vector<Region>& regions, const Normals& normals,
                    std::size_t triangle, unsigned threads, Shell& shell) {
  grow(shell.corner_normals, 3 * shell.triangles.size());
  const auto fill_row = [&](std::size_t ring, Side side, const Range& spans, RowOfNormals& row) {
    std::size_t column = spans.begin % grid.columns;
    for (std::size_t i = 0; i <= spans.size(); ++i) {
      row[2 * i] = normals.at(ring, side, column, Side::Before);
      row[2 * i + 1] =
          normals.smooth_column(column) ? row[2 * i] : normals.at(ring, side, column, Side::After);
      column = grid.next_column(column);
    }
  };
  for (const Region& region : regions) {
    const Range &strips = region.strips, &spans = region.spans;
    const std::size_t per_strip = triangles_in_strip(grid, spans);
    parallel_for(strips.size(), grain_of(per_strip), threads, [&](std::size_t begin, std::size_t end) {
      RowOfNormals near(2 * spans.size() + 2), far(near.size());
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t ring = (strips.begin + i) % grid.rings;
        std::swap(near, far);
        if (i == begin || !normals.smooth(ring)) fill_row(ring, Side::After, spans, near);
        fill_row(grid.next_ring(ring), Side::Before, spans, far);
        fill_strip_normals(grid, spans, near, far, triangle + i * per_strip, shell);
      }
    });
    triangle += per_strip * strips.size();
  }
}

}  // namespace meshcontour::detail

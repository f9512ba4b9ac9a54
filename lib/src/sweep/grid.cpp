#include "sweep/grid.hpp"

namespace meshcontour::detail {

std::size_t triangles_in_strip(const Grid& grid, const Range& spans) {
  std::size_t count = 2 * spans.size();
  if (grid.first_pole && spans.begin == 0) --count;
  if (grid.last_pole && spans.end + 1 == grid.columns) --count;
  return count;
}

void append_triangles(const Grid& grid, const std::vector<Region>& regions, unsigned threads, Shell& shell) {
  for (const Region& region : regions) {
    const std::size_t first = shell.triangles.size(), row = triangles_in_strip(grid, region.spans);
    grow(shell.triangles, first + row * region.strips.size());
    shell.patches.push_back({region.name, shell.color, first, row * region.strips.size()});
    const auto fill_strip = [&](std::size_t strip, std::size_t triangle) {
      const std::size_t ring = strip % grid.rings, next_ring = grid.next_ring(ring);
      std::size_t column = region.spans.begin % grid.columns;
      for (std::size_t span = region.spans.begin; span < region.spans.end; ++span) {
        const std::size_t next = grid.next_column(column);
        const CellTriangles cell = cell_triangles(grid, column);
        const std::array<Index, 4> points = {grid.point(ring, column), grid.point(ring, next),
                                             grid.point(next_ring, column), grid.point(next_ring, next)};
        for (std::size_t k = cell.first; k < cell.last; ++k) {
          const auto& [a, b, c] = cell.corners[k];
          shell.triangles[triangle++] = {points[a], points[b], points[c]};
        }
        column = next;
      }
    };
    parallel_for(region.strips.size(), grain_of(row), threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) fill_strip(region.strips.begin + i, first + i * row);
    });
  }
}

void flip_triangles(Shell& shell, std::size_t first_triangle) {
  for (std::size_t i = first_triangle; i < shell.triangles.size(); ++i) {
    std::swap(shell.triangles[i][1], shell.triangles[i][2]);
  }
}

double signed_volume(const Shell& shell, std::size_t first_triangle) {
  if (first_triangle >= shell.triangles.size()) return 0;
  const Point origin = shell.points[shell.triangles[first_triangle][0]];
  double sum = 0;
  for (std::size_t i = first_triangle; i < shell.triangles.size(); ++i) {
    const auto& [a, b, c] = shell.triangles[i];
    sum += (shell.points[a] - origin).dot((shell.points[b] - origin).cross(shell.points[c] - origin));
  }
  return sum;
}

void fill_strip_normals(const Grid& grid, const Range& spans, const RowOfNormals& near,
                        const RowOfNormals& far, std::size_t triangle, Shell& shell) {
  const double sign = grid.flip ? -1 : 1;
  std::size_t column = spans.begin % grid.columns;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const std::array<Vector, 4> normals = {sign * near[2 * i + 1], sign * near[2 * i + 2],
                                           sign * far[2 * i + 1], sign * far[2 * i + 2]};
    const CellTriangles cell = cell_triangles(grid, column);
    for (std::size_t k = cell.first; k < cell.last; ++k, ++triangle) {
      const auto& [a, b, c] = shell.triangles[triangle];
      const Vector area = (shell.points[b] - shell.points[a]).cross(shell.points[c] - shell.points[a]);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        shell.corner_normals[3 * triangle + corner] = agreeing_normal(normals[cell.corners[k][corner]], area);
      }
    }
    column = grid.next_column(column);
  }
}

}  // namespace meshcontour::detail

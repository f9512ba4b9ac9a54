#include "sweep/grid.hpp"

namespace meshcontour::detail {

std::size_t Grid::point_count() const {
  const std::size_t poles = (first_pole ? 1U : 0U) + (last_pole ? 1U : 0U);
  return rings * (columns - poles) + poles;
}

bool Grid::is_pole(std::size_t column) const {
  return (first_pole && column == 0) || (last_pole && column + 1 == columns);
}

Index Grid::point(std::size_t ring, std::size_t column) const {
  ring %= rings;
  column %= columns;
  if (first_pole && column == 0) return static_cast<Index>(base);
  if (last_pole && column + 1 == columns) return static_cast<Index>(base + point_count() - 1);
  const std::size_t before = first_pole ? 1 : 0;
  const std::size_t width = columns - before - (last_pole ? 1 : 0);
  return static_cast<Index>(base + before + ring * width + column - before);
}

CellTriangles cell_triangles(const Grid& grid, std::size_t span) {
  CellTriangles cell{{{{0, 1, 2}, {2, 1, 3}}}};
  if (grid.flip) cell.corners = {{{0, 2, 1}, {2, 3, 1}}};
  if (grid.is_pole(span % grid.columns)) cell.first = 1;
  if (grid.is_pole((span + 1) % grid.columns)) cell.last = 1;
  return cell;
}

std::size_t triangles_in_strip(const Grid& grid, const Region& region) {
  std::size_t count = 2 * region.spans.size();
  if (grid.first_pole && region.spans.begin == 0) --count;
  if (grid.last_pole && region.spans.end + 1 == grid.columns) --count;
  return count;
}

void append_triangles(const Grid& grid, const std::vector<Region>& regions, unsigned threads, Shell& shell) {
  for (const Region& region : regions) {
    const std::size_t first = shell.triangles.size(), row = triangles_in_strip(grid, region);
    shell.triangles.resize(first + row * region.strips.size());
    shell.patches.push_back({region.name, shell.color, first, row * region.strips.size()});
    const auto fill_strip = [&](std::size_t strip, std::size_t triangle) {
      for (std::size_t span = region.spans.begin; span < region.spans.end; ++span) {
        const CellTriangles cell = cell_triangles(grid, span);
        const std::array<Index, 4> points = {grid.point(strip, span), grid.point(strip, span + 1),
                                             grid.point(strip + 1, span), grid.point(strip + 1, span + 1)};
        for (std::size_t k = cell.first; k < cell.last; ++k) {
          const auto& [a, b, c] = cell.corners[k];
          shell.triangles[triangle++] = {points[a], points[b], points[c]};
        }
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

Vector agreeing_normal(const Vector& normal, const Vector& area_vector) {
  if (normal.dot(area_vector) > 0 || area_vector == Vector::Zero()) return normal;
  return area_vector.normalized();
}

}  // namespace meshcontour::detail

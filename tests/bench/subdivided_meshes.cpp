#include "bench/subdivided_meshes.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "meshcontour/simplification.hpp"
#include "meshcontour/subdivision.hpp"
#include "multires/triangle_tree.hpp"

using namespace meshcontour;

namespace bench {
namespace {

constexpr double kPi = std::numbers::pi;

Shell shell_of(std::vector<Point> points, std::vector<Triangle> triangles) {
  Shell shell;
  shell.id = "bench";
  shell.points = std::move(points);
  shell.triangles = std::move(triangles);
  shell.patches = {{"", {}, 0, shell.triangles.size()}};
  return shell;
}

// Waves in all directions, between -1 and 1, several on a length of 1.
double waves(const Point& p) {
  return std::sin(5 * p.x() + 1) * std::cos(4 * p.y()) * 0.6 + std::sin(9 * p.z() + 3 * p.x()) * 0.25 +
         std::cos(13 * p.y() - 7 * p.z()) * 0.15;
}

Shell icosahedron() {
  const double g = std::numbers::phi;
  return shell_of({{-1, g, 0},
                   {1, g, 0},
                   {-1, -g, 0},
                   {1, -g, 0},
                   {0, -1, g},
                   {0, 1, g},
                   {0, -1, -g},
                   {0, 1, -g},
                   {g, 0, -1},
                   {g, 0, 1},
                   {-g, 0, -1},
                   {-g, 0, 1}},
                  {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                   {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                   {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}});
}

Shell bumpy_icosphere() {
  Shell shell = subdivided(icosahedron(), 6);
  for (Point& p : shell.points) {
    p.normalize();
    p *= 1 + 0.12 * waves(p);
  }
  return shell;
}

// A cube rounded to |x|^8 + |y|^8 + |z|^8 = 1: flat sides, sharp bends between them.
Shell rounded_cube() {
  Shell shell = subdivided(icosahedron(), 6);
  for (Point& p : shell.points) {
    const double length = std::pow(p.array().abs().pow(8).sum(), 1.0 / 8);
    p /= length;
  }
  return shell;
}

// A grid of the unit square's points, closed in both directions or in none.
Shell grid(Index columns, Index rows, bool closed, const std::function<Point(double, double)>& at) {
  const Index width = closed ? columns : columns + 1, height = closed ? rows : rows + 1;
  std::vector<Point> points;
  for (Index i = 0; i < width; ++i) {
    for (Index j = 0; j < height; ++j) points.push_back(at(double(i) / columns, double(j) / rows));
  }
  std::vector<Triangle> triangles;
  for (Index i = 0; i < columns; ++i) {
    for (Index j = 0; j < rows; ++j) {
      const Index a = i * height + j, b = (i + 1) % width * height + j,
                  c = (i + 1) % width * height + (j + 1) % height, d = i * height + (j + 1) % height;
      triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
    }
  }
  return shell_of(std::move(points), std::move(triangles));
}

Shell bumpy_torus() {
  return grid(192, 96, true, [](double u, double v) {
    const double a = 2 * kPi * u, b = 2 * kPi * v;
    const Point ring(std::cos(a), std::sin(a), 0);
    const Vector out = std::cos(b) * ring + std::sin(b) * Vector::UnitZ();
    const Point p = ring + 0.4 * out;
    return Point(p + 0.05 * waves(1.5 * p) * out);
  });
}

Shell open_waves() {
  return grid(112, 112, false, [](double u, double v) {
    const Point flat(2 * u - 1, 2 * v - 1, 0);
    const double peak = std::exp(-20 * (flat - Point(0.3, 0.2, 0)).squaredNorm());
    return Point(flat.x(), flat.y(), 0.15 * waves(flat) + 0.3 * peak);
  });
}

// The outside of unit cubes: a body with legs, a neck and a head.
Shell cube_animal() {
  const std::set<std::array<int, 3>> cubes = {
      {0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {3, 0, 1}, {0, 1, 1}, {1, 1, 1}, {2, 1, 1}, {3, 1, 1}, {0, 0, 0},
      {3, 0, 0}, {0, 1, 0}, {3, 1, 0}, {3, 0, 2}, {3, 1, 2}, {4, 0, 2}, {4, 1, 2}, {-1, 0, 1}};
  std::map<std::array<int, 3>, Index> numbers;
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [found, added] = numbers.try_emplace(at, static_cast<Index>(points.size()));
    if (added) points.push_back(Point(at[0], at[1], at[2]));
    return found->second;
  };
  for (const auto& cube : cubes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        std::array<int, 3> beside = cube;
        beside[axis] += 2 * side - 1;
        if (cubes.count(beside)) continue;
        std::array<Index, 4> corners{};
        for (int k = 0; k < 4; ++k) {
          std::array<int, 3> at = cube;
          at[axis] += side;
          at[(axis + 1) % 3] += k == 1 || k == 2;
          at[(axis + 2) % 3] += k >= 2;
          corners[std::size_t(side == 1 ? k : 3 - k)] = vertex(at);
        }
        triangles.push_back({corners[0], corners[1], corners[2]});
        triangles.push_back({corners[0], corners[2], corners[3]});
      }
    }
  }
  return shell_of(std::move(points), std::move(triangles));
}

Shell bumpy_animal() {
  Shell shell = subdivided(cube_animal(), 5);
  std::vector<Vector> normals(shell.points.size(), Vector::Zero());
  for (const auto& [a, b, c] : shell.triangles) {
    const Vector normal = (shell.points[b] - shell.points[a]).cross(shell.points[c] - shell.points[a]);
    for (const Index v : {a, b, c}) normals[v] += normal;
  }
  for (std::size_t v = 0; v < normals.size(); ++v) {
    shell.points[v] += 0.04 * waves(shell.points[v]) * normals[v].normalized();
  }
  return shell;
}

}  // namespace

std::vector<SubdividedMesh> subdivided_meshes() {
  return {{"bumpy icosphere", bumpy_icosphere},
          {"bumpy torus", bumpy_torus},
          {"bumpy animal", bumpy_animal},
          {"open waves", open_waves},
          {"rounded cube", rounded_cube}};
}

Shell projected(const Shell& shell, std::size_t base, unsigned levels) {
  Shell coarse = shell;
  SimplifyOptions options;
  options.method = SimplifyMethod::Qem;
  options.goal = SimplifyGoal::Triangles;
  options.value = static_cast<double>(base);
  simplify_shell(coarse, options, base);
  const detail::TriangleTree tree(shell.points, shell.triangles);
  for (unsigned level = 0; level < levels; ++level) {
    coarse = subdivided(coarse, 1);
    for (Point& p : coarse.points) p = detail::nearest_point(tree.corners(tree.nearest(p).triangle), p);
  }
  return coarse;
}

}  // namespace bench

#pragma once

// Curved surfaces with patches, and what is true of any mesh.

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include "meshcontour/boundary.hpp"
#include "meshcontour/segmentation.hpp"
#include "meshcontour/subdivision.hpp"
#include "multires/triangle_tree.hpp"

namespace surfaces {

using namespace meshcontour;

/// A number in [-1, 1), the same on every machine.
inline double uniform(std::mt19937& random) {
  return static_cast<double>(random()) / 2147483648.0 - 1;
}

inline Shell shell_of(std::vector<Point> points, std::vector<Triangle> triangles) {
  Shell shell;
  shell.id = "surface";
  shell.points = std::move(points);
  shell.triangles = std::move(triangles);
  shell.patches = {{"", {}, 0, shell.triangles.size()}};
  return shell;
}

/// `count` triangles from the rim of a unit disk to its middle, which is raised.
inline Shell fan(Index count, double height = 0) {
  std::vector<Point> points = {{0, 0, height}};
  std::vector<Triangle> triangles;
  for (Index i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    points.push_back({std::cos(angle), std::sin(angle), 0});
    triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
  }
  return shell_of(std::move(points), std::move(triangles));
}

/// A polygon cut into `count` triangles from its vertex 0.
inline Shell corner_fan(Index count) {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  for (Index i = 0; i < count + 2; ++i) {
    const double angle = 2 * std::numbers::pi * i / (count + 2);
    points.push_back({std::cos(angle), std::sin(angle), 0});
    if (i > 1) triangles.push_back({0, i - 1, i});
  }
  return shell_of(std::move(points), std::move(triangles));
}

inline Shell octahedron() {
  return shell_of({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                  {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

/// An octahedron cut `levels` times and blown up to a sphere with bumps; its eight sides are patches.
inline Shell bumpy_sphere(unsigned levels, double bump = 0.1) {
  Shell shell = octahedron();
  group_triangles(shell, {0, 1, 2, 3, 4, 5, 6, 7});
  shell = subdivided(shell, levels);
  for (Point& p : shell.points) {
    p.normalize();
    p *= 1 + bump * std::sin(5 * p.x()) * std::cos(4 * p.y() + p.z());
  }
  return shell;
}

/// n x n squares of two triangles over [0, 1]^2, with heights; the left and the right half are patches, and
/// there is a square hole in each where `holes`.
inline Shell height_field(Index n, bool holes, double height = 0.1) {
  std::vector<Point> points;
  for (Index i = 0; i <= n; ++i) {
    for (Index j = 0; j <= n; ++j) {
      const double x = double(i) / n, y = double(j) / n;
      points.push_back({x, y, height * std::sin(6 * x) * std::cos(5 * y)});
    }
  }
  std::vector<Triangle> triangles;
  std::vector<Index> sides;
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const bool hole = (i * 8 / n == 1 || i * 8 / n == 6) && j * 8 / n == 4;
      if (holes && hole) continue;
      const Index a = i * (n + 1) + j, b = a + n + 1;
      triangles.insert(triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
      sides.insert(sides.end(), 2, 2 * i / n);
    }
  }
  Shell shell = shell_of(std::move(points), std::move(triangles));
  group_triangles(shell, sides);
  return shell;
}

/// Triangles and vertices in a random order, corners rotated; patches stay.
inline Shell shuffled(const Shell& shell, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto permutation = [&](std::size_t count) {
    std::vector<Index> order(count);
    for (Index i = 0; i < count; ++i) order[i] = i;
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    return order;
  };
  Shell out = shell;
  const std::vector<Index> place = permutation(shell.points.size());
  for (std::size_t v = 0; v < place.size(); ++v) out.points[place[v]] = shell.points[v];
  for (const Patch& patch : shell.patches) {
    const std::vector<Index> order = permutation(patch.triangle_count);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Triangle& t = shell.triangles[patch.first_triangle + order[i]];
      const std::size_t turn = random() % 3;
      Triangle& to = out.triangles[patch.first_triangle + i];
      for (std::size_t k = 0; k < 3; ++k) to[k] = place[t[(k + turn) % 3]];
    }
  }
  return out;
}

/// The largest distance of points spread over one surface to all triangles of the other, patch to patch.
inline double sampled_distance(const Shell& from, const Shell& to) {
  double worst = 0;
  for (std::size_t p = 0; p < from.patches.size(); ++p) {
    for (const Triangle& t : from.patch_triangles(p)) {
      for (int i = 0; i <= 2; ++i) {
        for (int j = 0; i + j <= 2; ++j) {
          const Point q =
              (i * from.points[t[0]] + j * from.points[t[1]] + (2 - i - j) * from.points[t[2]]) / 2;
          double nearest = 1e300;
          for (const Triangle& u : to.patch_triangles(p)) {
            const detail::Corners corners = {to.points[u[0]], to.points[u[1]], to.points[u[2]]};
            nearest = std::min(nearest, (detail::nearest_point(corners, q) - q).norm());
          }
          worst = std::max(worst, nearest);
        }
      }
    }
  }
  return worst;
}

struct Topology {
  bool manifold = true;  ///< no edge has three triangles or two that run the same way, one fan a vertex
  int euler = 0;
  std::size_t border_edges = 0;
};

inline Topology topology_of(const Shell& shell) {
  Topology topology;
  std::map<std::pair<Index, Index>, int> runs;
  std::map<Index, std::map<Index, Index>> fans;  // of a vertex: from each neighbour to the next
  for (const Triangle& t : shell.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      topology.manifold &= ++runs[{t[k], t[(k + 1) % 3]}] == 1;
      fans[t[k]][t[(k + 1) % 3]] = t[(k + 2) % 3];
    }
  }
  std::set<std::pair<Index, Index>> edges;
  for (const auto& [edge, count] : runs) {
    edges.insert(std::minmax(edge.first, edge.second));
    topology.border_edges += runs.count({edge.second, edge.first}) == 0;
  }
  for (const auto& [vertex, next] : fans) {
    // One chain or one cycle: start where nothing leads to.
    std::set<Index> reached;
    for (const auto& [from, to] : next) reached.insert(to);
    Index at = next.begin()->first;
    for (const auto& [from, to] : next) at = reached.count(from) == 0 ? from : at;
    std::size_t seen = 0;
    for (auto found = next.find(at); found != next.end() && seen <= next.size();
         found = next.find(found->second))
      ++seen;
    const bool closed =
        reached.size() == next.size() && std::equal(reached.begin(), reached.end(), next.begin(),
                                                    [](Index a, const auto& b) { return a == b.first; });
    topology.manifold &= closed ? seen == next.size() + 1 : seen == next.size();
  }
  topology.euler = int(fans.size()) - int(edges.size()) + int(shell.triangles.size());
  return topology;
}

inline std::vector<ShellBoundary> boundaries_of(const Shell& shell) {
  Model model;
  model.shells = {shell};
  std::vector<Diagnostic> notes;
  return extract_boundaries(model, {}, notes);
}

/// Whether the second shell's loops are the first's with vertices left out: number, order and first vertex
/// the same.
inline bool loops_thinned(const Shell& before, const Shell& after) {
  const auto a = boundaries_of(before), b = boundaries_of(after);
  for (std::size_t p = 0; p < before.patches.size(); ++p) {
    const auto &old_loops = a[0].patches[p].loops, &new_loops = b[0].patches[p].loops;
    if (old_loops.size() != new_loops.size()) return false;
    for (std::size_t l = 0; l < old_loops.size(); ++l) {
      const auto &old_vertices = old_loops[l].vertices, &new_vertices = new_loops[l].vertices;
      if (before.points[old_vertices[0]] != after.points[new_vertices[0]]) return false;
      std::size_t at = 0;
      for (const Index v : new_vertices) {
        while (at < old_vertices.size() && before.points[old_vertices[at]] != after.points[v]) ++at;
        if (at++ == old_vertices.size()) return false;
      }
    }
  }
  return true;
}

}  // namespace surfaces

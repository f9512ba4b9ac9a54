#include "support/meshes.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>

namespace meshes {
namespace {

// Splits the squares of a lattice; `vertex` numbers its nodes, so that it also glues them.
std::vector<Triangle> lattice(Index columns, Index rows, const std::function<Index(Index, Index)>& vertex) {
  std::vector<Triangle> triangles;
  for (Index row = 0; row < rows; ++row) {
    for (Index column = 0; column < columns; ++column) {
      const Index a = vertex(column, row), b = vertex(column + 1, row);
      const Index c = vertex(column + 1, row + 1), d = vertex(column, row + 1);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return triangles;
}

std::vector<Index> random_order(std::size_t count, std::mt19937& random) {
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), Index{0});
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

std::string sized(const char* name, Index a, Index b) {
  return std::string(name) + " " + std::to_string(a) + " x " + std::to_string(b);
}

}  // namespace

Mesh grid(Index columns, Index rows, Index hole_pitch) {
  Mesh mesh{sized("grid", columns, rows), std::size_t{columns + 1} * (rows + 1), {}, true, true, 1, 2};
  const auto vertex = [&](Index column, Index row) { return row * (columns + 1) + column; };
  const auto is_hole = [&](Index k) { return hole_pitch > 0 && k % (2 * hole_pitch) == hole_pitch; };
  const std::vector<Triangle> all = lattice(columns, rows, vertex);
  for (Index row = 0; row < rows; ++row) {
    for (Index column = 0; column < columns; ++column) {
      if (is_hole(column) && is_hole(row)) {
        if (column + 1 < columns && row + 1 < rows) ++*mesh.loops;
        continue;
      }
      const std::size_t first = 2 * (std::size_t{row} * columns + column);
      mesh.triangles.insert(mesh.triangles.end(), {all[first], all[first + 1]});
    }
  }
  if (hole_pitch > 0) mesh.name += " with holes";
  return mesh;
}

Mesh disc(Index triangles) {
  Mesh mesh{"disc of " + std::to_string(triangles), std::size_t{triangles} + 1, {}, true, true, 1, 2};
  for (Index i = 0; i < triangles; ++i) mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % triangles});
  return mesh;
}

Mesh cylinder(Index around, Index along) {
  const auto vertex = [&](Index i, Index j) { return j * around + i % around; };
  return {sized("cylinder", around, along),
          std::size_t{around} * (along + 1),
          lattice(around, along, vertex),
          true,
          true,
          2,
          2};
}

Mesh torus(Index around, Index along) {
  const auto vertex = [&](Index i, Index j) { return j % along * around + i % around; };
  return {sized("torus", around, along),
          std::size_t{around} * along,
          lattice(around, along, vertex),
          true,
          true,
          0};
}

Mesh sphere(Index around, Index along) {
  Mesh mesh = cylinder(around, along);
  const auto south = static_cast<Index>(mesh.vertices), north = south + 1;
  for (Index i = 0; i < around; ++i) {
    const Index next = (i + 1) % around;
    mesh.triangles.push_back({south, next, i});
    mesh.triangles.push_back({north, along * around + i, along * around + next});
  }
  mesh.name = sized("sphere", around, along);
  mesh.vertices += 2;
  mesh.loops = 0;
  return mesh;
}

Mesh moebius(Index around, Index along) {
  const auto vertex = [&](Index i, Index j) { return i == around ? along - j : i * (along + 1) + j; };
  return {sized("Moebius strip", around, along),
          std::size_t{around} * (along + 1),
          lattice(around, along, vertex),
          true,
          false,
          1,
          1};
}

Mesh klein_bottle(Index around, Index along) {
  const auto vertex = [&](Index i, Index j) {
    return i == around ? (along - j % along) % along : i * along + j % along;
  };
  return {sized("Klein bottle", around, along),
          std::size_t{around} * along,
          lattice(around, along, vertex),
          true,
          false,
          0};
}

Mesh separate_triangles(Index count) {
  Mesh mesh{std::to_string(count) + " separate triangles",
            3 * std::size_t{count},
            {},
            true,
            true,
            count,
            2 * static_cast<int>(count)};
  for (Index i = 0; i < count; ++i) mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  return mesh;
}

Mesh bow_tie(Index triangles) {
  Mesh mesh{"bow-tie of " + std::to_string(triangles),
            2 * std::size_t{triangles} + 1,
            {},
            triangles == 1,
            true,
            triangles,
            2};
  for (Index i = 0; i < triangles; ++i) mesh.triangles.push_back({0, 2 * i + 1, 2 * i + 2});
  return mesh;
}

Mesh pinched_tube(Index around) {
  Mesh mesh{"pinched tube of " + std::to_string(around), 2 * std::size_t{around} + 1, {}, false, true, 2};
  for (Index i = 0; i < around; ++i) {
    const Index next = (i + 1) % around;
    mesh.triangles.push_back({0, 1 + i, 1 + next});
    mesh.triangles.push_back({0, 1 + around + next, 1 + around + i});
  }
  return mesh;
}

Mesh touching_hole() {
  // Outer corners 0 1 2 3, the vertex 4 in the lower edge, and the rest of the hole 5 6 7 (right, top, left).
  return {"hole that touches the outside",
          8,
          {{0, 4, 7}, {0, 7, 3}, {3, 7, 6}, {3, 6, 2}, {2, 6, 5}, {2, 5, 1}, {1, 5, 4}},
          false,
          true,
          1};
}

Mesh fin(Index triangles) {
  Mesh mesh{
      "fin of " + std::to_string(triangles), std::size_t{triangles} + 2, {}, triangles < 3, true, {}, 2};
  for (Index i = 0; i < triangles; ++i) {
    mesh.triangles.push_back(i % 2 == 0 ? Triangle{0, 1, 2 + i} : Triangle{1, 0, 2 + i});
  }
  return mesh;
}

Mesh stacked_tetrahedra(Index count) {
  Mesh mesh{std::to_string(count) + " tetrahedra on an edge",
            2 + 2 * std::size_t{count},
            {},
            count < 2,
            true,
            0,
            2};
  for (Index i = 0; i < count; ++i) {
    const Index a = 2 + 2 * i, b = a + 1;
    mesh.triangles.insert(mesh.triangles.end(), {{0, 1, a}, {1, 0, b}, {0, a, b}, {1, b, a}});
  }
  return mesh;
}

Mesh soup(Index vertices, Index triangles, std::uint32_t seed) {
  Mesh mesh{sized("soup", vertices, triangles) + " #" + std::to_string(seed), vertices, {}, false, false, {}};
  std::mt19937 random(seed);
  const auto vertex = [&] { return static_cast<Index>(random() % vertices); };
  for (Index i = 0; i < triangles; ++i) {
    const Index a = vertex(), b = vertex(), c = vertex();
    mesh.triangles.push_back({a, b, c});
  }
  return mesh;
}

Mesh shuffled(const Mesh& mesh, std::uint32_t seed) {
  std::mt19937 random(seed);
  Mesh result = mesh;
  result.name += ", shuffled";
  result.vertices = 2 * mesh.vertices + 5;
  const std::vector<Index> number = random_order(result.vertices, random);
  const std::vector<Index> order = random_order(mesh.triangles.size(), random);
  for (std::size_t i = 0; i < order.size(); ++i) {
    Triangle t = mesh.triangles[order[i]];
    for (Index& v : t) v = number[v];
    std::ranges::rotate(t, t.begin() + static_cast<std::ptrdiff_t>(random() % 3));
    result.triangles[i] = t;
  }
  return result;
}

Mesh partly_flipped(const Mesh& mesh, std::uint32_t seed, std::uint32_t one_in) {
  std::mt19937 random(seed);
  Mesh result = mesh;
  result.name += ", partly flipped";
  for (Triangle& t : result.triangles) {
    if (random() % one_in == 0) std::swap(t[0], t[1]);
  }
  return result;
}

Mesh united(const Mesh& a, const Mesh& b) {
  Mesh result = a;
  result.name += " and " + b.name;
  for (Triangle t : b.triangles) {
    for (Index& v : t) v += static_cast<Index>(a.vertices);
    result.triangles.push_back(t);
  }
  result.vertices += b.vertices;
  result.manifold = a.manifold && b.manifold;
  result.orientable = a.orientable && b.orientable;
  result.closed_euler += b.closed_euler;
  result.loops = a.loops && b.loops ? std::optional(*a.loops + *b.loops) : std::nullopt;
  return result;
}

std::vector<Mesh> family() {
  std::vector<Mesh> plain = {grid(1, 1),
                             grid(5, 3),
                             grid(20, 20, 2),
                             grid(31, 17, 1),
                             disc(3),
                             disc(50),
                             disc(300),
                             cylinder(3, 1),
                             cylinder(17, 1),
                             cylinder(24, 9),
                             torus(3, 3),
                             torus(16, 12),
                             sphere(3, 1),
                             sphere(20, 11),
                             moebius(5),
                             moebius(12),
                             moebius(30, 5),
                             klein_bottle(5, 4),
                             klein_bottle(16, 9),
                             separate_triangles(1),
                             separate_triangles(300),
                             bow_tie(2),
                             bow_tie(7),
                             bow_tie(250),
                             pinched_tube(4),
                             pinched_tube(150),
                             touching_hole(),
                             fin(2),
                             fin(3),
                             fin(4),
                             fin(5),
                             fin(301),
                             stacked_tetrahedra(1),
                             stacked_tetrahedra(2),
                             stacked_tetrahedra(80)};
  plain.push_back(united(sphere(8, 4), grid(1, 1)));
  plain.push_back(united(moebius(12), grid(20, 20, 2)));
  std::vector<Mesh> meshes;
  for (std::uint32_t seed = 1; const Mesh& mesh : plain) {
    meshes.push_back(mesh);
    meshes.push_back(shuffled(mesh, ++seed));
    meshes.push_back(shuffled(partly_flipped(mesh, seed, 3), seed));
  }
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    meshes.push_back(soup(5, 4 * seed, seed));
    meshes.push_back(soup(40, 60 * seed, seed));
    meshes.push_back(soup(400, 100 * seed, seed));
  }
  return meshes;
}

meshcontour::Shell shell(const Mesh& mesh) {
  meshcontour::Shell shell;
  shell.id = mesh.name;
  for (std::size_t i = 0; i < mesh.vertices; ++i) {
    const auto k = static_cast<double>(i);
    shell.points.emplace_back(k, k * k / static_cast<double>(mesh.vertices), 1 / (1 + k));
  }
  shell.triangles = mesh.triangles;
  shell.patches.push_back({mesh.name, {}, 0, mesh.triangles.size()});
  return shell;
}

meshcontour::Model model(const std::vector<Mesh>& patches) {
  Mesh all{"generated", 0, {}, false, false, {}};
  std::vector<meshcontour::Patch> ranges;
  for (const Mesh& mesh : patches) {
    ranges.push_back({mesh.name, {}, all.triangles.size(), mesh.triangles.size()});
    all.triangles.insert(all.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
    all.vertices = std::max(all.vertices, mesh.vertices);
  }
  meshcontour::Model model;
  model.name = all.name;
  model.shells.push_back(shell(all));
  model.shells[0].patches = std::move(ranges);
  model.instances.push_back({0, Eigen::Affine3d::Identity(), all.name});
  return model;
}

}  // namespace meshes

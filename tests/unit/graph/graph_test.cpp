#include "meshcontour/graph.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/prim_minimum_spanning_tree.hpp>
#include <limits>

#include "graph/edge_graph.hpp"
#include "meshcontour/segmentation.hpp"
#include "support/catch.hpp"
#include "support/dirty_meshes.hpp"

using namespace meshcontour;

namespace {

double edge_length(const Shell& shell, Index from, Index to) {
  return (shell.points[to] - shell.points[from]).norm();
}

// The length of the spanning forest by Prim's algorithm, and its number of trees.
std::pair<double, std::size_t> by_prim(const Shell& shell) {
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property,
                                      boost::property<boost::edge_weight_t, double>>;
  Graph graph(shell.points.size());
  std::vector<std::size_t> used(shell.points.size(), 0);
  for (const auto& [edge, triangles] : dirty::triangles_by_edge(shell)) {
    used[edge.first] = used[edge.second] = 1;
    if (edge.first != edge.second) {
      add_edge(edge.first, edge.second, edge_length(shell, edge.first, edge.second), graph);
    }
  }
  double length = 0;
  std::size_t trees = 0;
  for (std::size_t root = 0; root < used.size(); ++root) {
    if (used[root] == 0) continue;
    ++trees;
    std::vector<Graph::vertex_descriptor> parent(used.size());
    for (std::size_t v = 0; v < parent.size(); ++v) parent[v] = v;
    boost::prim_minimum_spanning_tree(graph, parent.data(), boost::root_vertex(root));
    used[root] = 0;
    for (std::size_t v = 0; v < parent.size(); ++v) {
      if (parent[v] == v) continue;
      used[v] = 0;
      length += edge_length(shell, static_cast<Index>(v), static_cast<Index>(parent[v]));
    }
  }
  return {length, trees};
}

// Shortest distances between all vertices, by relaxing every edge until nothing changes.
std::vector<double> distances_from(const Shell& shell, Index from) {
  std::vector<double> distance(shell.points.size(), std::numeric_limits<double>::infinity());
  distance[from] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [edge, triangles] : dirty::triangles_by_edge(shell)) {
      const double length = edge_length(shell, edge.first, edge.second);
      for (const auto& [a, b] : {edge, std::pair{edge.second, edge.first}}) {
        if (distance[a] + length >= distance[b] - 1e-12) continue;
        distance[b] = distance[a] + length;
        changed = true;
      }
    }
  }
  return distance;
}

std::vector<Shell> meshes() {
  return {
      dirty::cube(),         dirty::torus(),   dirty::band(9, 0), dirty::moebius_strip(),
      dirty::klein_bottle(), dirty::bow_tie(), dirty::fin(),      dirty::two_cubes_touching_in_a_vertex()};
}

std::size_t edge_count(const EdgePaths& lines) {
  std::size_t count = 0;
  for (const auto& path : lines.paths) count += path.size() - 1;
  return count;
}

}  // namespace

TEST_CASE("minimum_spanning_tree: as long as Prim's, with one edge less than vertices a tree", "[graph]") {
  for (const Shell& shell : meshes()) {
    const EdgePaths tree = minimum_spanning_tree(shell, 0);
    const auto [length, trees] = by_prim(shell);
    CHECK(tree.length == Approx(length));
    CHECK(edge_count(tree) == shell.points.size() - trees);
    std::set<Index> reached;
    for (const auto& path : tree.paths) reached.insert(path.begin(), path.end());
    CHECK(reached.size() == shell.points.size());
  }
}

TEST_CASE("minimum_spanning_tree: random soups, components and all", "[graph][property]") {
  std::mt19937 random(17);
  for (int round = 0; round < 100; ++round) {
    Shell shell = dirty::soup(random, static_cast<Index>(4 + random() % 30), random() % 30);
    std::erase_if(shell.triangles,
                  [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    shell.patches[0].triangle_count = shell.triangles.size();
    CHECK(minimum_spanning_tree(shell, 0).length == Approx(by_prim(shell).first));
  }
}

TEST_CASE("minimum_spanning_tree: one patch at a time, and only one that exists", "[graph]") {
  Shell shell = dirty::cube();
  segment_by_feature_angle(shell, 0.5);
  for (std::size_t p = 0; p < 6; ++p) CHECK(minimum_spanning_tree(shell, p).length == Approx(3));
  CHECK_THROWS_WITH(minimum_spanning_tree(shell, 6), "there is no patch 7: the shell has 6");
}

TEST_CASE("edge graphs: halfedges and plain edges agree on what both can hold", "[graph]") {
  for (const Shell& shell : {dirty::cube(), dirty::torus(), dirty::band(9, 0)}) {
    HalfedgePatch halfedges = to_surface_mesh(shell, 0);
    REQUIRE(detail::holds_all_edges(halfedges));
    const detail::HalfedgeGraph mesh(std::move(halfedges));
    const detail::PlainEdgeGraph plain(shell.triangles);
    const auto length = [&](const std::vector<std::array<Index, 2>>& edges) {
      double sum = 0;
      for (const auto& [from, to] : edges) sum += edge_length(shell, from, to);
      return sum;
    };
    CHECK(length(detail::spanning_edges(mesh, shell)) ==
          Approx(length(detail::spanning_edges(plain, shell))));
  }
  CHECK_FALSE(detail::holds_all_edges(to_surface_mesh(dirty::bow_tie(), 0)));
  CHECK_FALSE(detail::holds_all_edges(to_surface_mesh(dirty::fin(), 0)));
}

TEST_CASE("shortest_path: as long as the shortest way by relaxation, edge by edge", "[graph]") {
  for (const Shell& shell : meshes()) {
    const auto edges = dirty::triangles_by_edge(shell);
    for (const Index from : {Index{0}, static_cast<Index>(shell.points.size() / 2)}) {
      const std::vector<double> expected = distances_from(shell, from);
      for (Index to = 0; to < shell.points.size(); ++to) {
        if (to == from) continue;
        const EdgePaths lines = shortest_path(shell, from, to);
        REQUIRE(lines.paths.size() == 1);
        const std::vector<Index>& path = lines.paths[0];
        CHECK(path.front() == from);
        CHECK(path.back() == to);
        CHECK(lines.length == Approx(expected[to]));
        for (std::size_t i = 1; i < path.size(); ++i)
          CHECK(edges.contains(std::minmax(path[i - 1], path[i])));
      }
    }
  }
}

TEST_CASE("shortest_path: what has no way is refused", "[graph][error]") {
  Shell apart = dirty::with_isolated_points(dirty::cube(), 1);
  CHECK_THROWS_WITH(shortest_path(apart, 0, 8), "no triangle uses vertex 8");
  CHECK_THROWS_WITH(shortest_path(apart, 99, 0), "there is no vertex 99: the shell has 9, numbered from 0");
  CHECK(shortest_path(apart, 3, 3).paths.empty());
  apart.points.resize(11, Point(9, 9, 9));
  apart.triangles.push_back({8, 9, 10});
  ++apart.patches[0].triangle_count;
  CHECK_THROWS_WITH(shortest_path(apart, 0, 9), "no edges join the vertices 0 and 9");
}

TEST_CASE("placed_lines: a line for every instance, where it stands", "[graph]") {
  Model model;
  model.shells = {dirty::cube(), dirty::torus()};
  model.instances = {{0, Eigen::Affine3d::Identity(), ""},
                     {1, Eigen::Affine3d::Identity(), ""},
                     {0, Eigen::Affine3d(Eigen::Translation3d(5, 0, 0)), ""}};
  const auto lines = placed_lines(model, 0, shortest_path(model.shells[0], 0, 1), "path");
  REQUIRE(lines.size() == 2);
  CHECK(lines[1].points == std::vector<Point>{{5, 0, 0}, {6, 0, 0}});
  CHECK(lines[1].name == "path");
}

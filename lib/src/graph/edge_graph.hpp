#pragma once

#include <CGAL/boost/graph/graph_traits_Surface_mesh.h>

#include <boost/graph/adjacency_list.hpp>
#include <span>
#include <vector>

#include "meshcontour/surface_mesh.hpp"

namespace meshcontour::detail {

/// A graph of edges that knows the shell's number of each of its vertices. For any triangles.
struct PlainEdgeGraph {
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;

  Graph graph;
  std::vector<Index> numbers;  ///< in the shell, one a vertex, rising

  explicit PlainEdgeGraph(std::span<const Triangle> triangles);
  Index number(Graph::vertex_descriptor vertex) const { return numbers[vertex]; }
};

/// The edges and vertices of a halfedge mesh as a graph.
struct HalfedgeGraph {
  using Graph = SurfaceMesh;

  Graph graph;
  Graph::Property_map<SurfaceMesh::Vertex_index, Index> numbers;

  explicit HalfedgeGraph(HalfedgePatch patch);
  Index number(SurfaceMesh::Vertex_index vertex) const { return numbers[vertex]; }
};

/// True when the mesh holds every triangle and each point of the shell once, so that its edges are those of
/// the triangles.
bool holds_all_edges(const HalfedgePatch& patch);

/// Kruskal's algorithm; edges as pairs of vertices of the shell.
template <typename EdgeGraph>
std::vector<std::array<Index, 2>> spanning_edges(const EdgeGraph& edges, const Shell& shell);

/// Dijkstra's algorithm; the vertices on the way, none if there is no way or the graph has not both ends.
template <typename EdgeGraph>
std::vector<Index> shortest_way(const EdgeGraph& edges, const Shell& shell, Index from, Index to);

}  // namespace meshcontour::detail

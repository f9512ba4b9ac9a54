#include "graph/edge_graph.hpp"

#include <algorithm>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/graph/kruskal_min_spanning_tree.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <utility>

namespace meshcontour::detail {
namespace {

template <typename EdgeGraph>
using Traits = boost::graph_traits<typename EdgeGraph::Graph>;

template <typename EdgeGraph>
auto edge_lengths(const EdgeGraph& edges, const Shell& shell) {
  using Edge = typename Traits<EdgeGraph>::edge_descriptor;
  return boost::make_function_property_map<Edge>([&](const Edge& edge) {
    const Point& from = shell.points[edges.number(source(edge, edges.graph))];
    const Point& to = shell.points[edges.number(target(edge, edges.graph))];
    return (to - from).norm();
  });
}

// Ends the search once the goal is reached.
struct Arrived {};

template <typename Vertex>
class StopAt : public boost::default_dijkstra_visitor {
 public:
  explicit StopAt(Vertex goal) : goal_(goal) {}

  template <typename Graph>
  void examine_vertex(Vertex vertex, const Graph&) const {
    if (vertex == goal_) throw Arrived();
  }

 private:
  Vertex goal_;
};

template <typename EdgeGraph>
auto find_vertex(const EdgeGraph& edges, Index number) {
  const auto [begin, end] = vertices(edges.graph);
  return std::find_if(begin, end, [&](auto vertex) { return edges.number(vertex) == number; });
}

template <typename Item>
void keep_different(std::vector<Item>& items) {
  std::ranges::sort(items);
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

}  // namespace

PlainEdgeGraph::PlainEdgeGraph(std::span<const Triangle> triangles) {
  std::vector<std::array<Index, 2>> edges;
  for (const auto& [a, b, c] : triangles) {
    for (const auto& [from, to] : {std::minmax(a, b), std::minmax(b, c), std::minmax(c, a)}) {
      if (from != to) edges.push_back({from, to});
    }
    numbers.insert(numbers.end(), {a, b, c});
  }
  keep_different(numbers);
  keep_different(edges);
  const auto place = [&](Index number) {
    return static_cast<std::size_t>(std::ranges::lower_bound(numbers, number) - numbers.begin());
  };
  graph = Graph(numbers.size());
  for (const auto& [from, to] : edges) add_edge(place(from), place(to), graph);
}

HalfedgeGraph::HalfedgeGraph(HalfedgePatch patch) : graph(std::move(patch.mesh)) {
  numbers = graph.property_map<SurfaceMesh::Vertex_index, Index>(std::string(property::kVertex)).first;
}

bool holds_all_edges(const HalfedgePatch& patch) {
  if (!patch.unheld.empty()) return false;
  const auto numbers =
      patch.mesh.property_map<SurfaceMesh::Vertex_index, Index>(std::string(property::kVertex)).first;
  std::vector<Index> sorted;
  for (const auto vertex : patch.mesh.vertices()) sorted.push_back(numbers[vertex]);
  std::ranges::sort(sorted);
  return std::ranges::adjacent_find(sorted) == sorted.end();
}

template <typename EdgeGraph>
std::vector<std::array<Index, 2>> spanning_edges(const EdgeGraph& edges, const Shell& shell) {
  std::vector<typename Traits<EdgeGraph>::edge_descriptor> tree;
  const auto index = get(boost::vertex_index, edges.graph);
  boost::kruskal_minimum_spanning_tree(edges.graph, std::back_inserter(tree),
                                       boost::weight_map(edge_lengths(edges, shell)).vertex_index_map(index));
  std::vector<std::array<Index, 2>> result;
  for (const auto& edge : tree) {
    result.push_back({edges.number(source(edge, edges.graph)), edges.number(target(edge, edges.graph))});
  }
  return result;
}

template <typename EdgeGraph>
std::vector<Index> shortest_way(const EdgeGraph& edges, const Shell& shell, Index from, Index to) {
  using Vertex = typename Traits<EdgeGraph>::vertex_descriptor;
  const auto end = vertices(edges.graph).second, start = find_vertex(edges, from),
             goal = find_vertex(edges, to);
  if (start == end || goal == end) return {};
  std::vector<Vertex> previous(num_vertices(edges.graph));
  const auto index = get(boost::vertex_index, edges.graph);
  const auto previous_map = boost::make_iterator_property_map(previous.begin(), index);
  bool arrived = *start == *goal;
  try {
    boost::dijkstra_shortest_paths(edges.graph, *start,
                                   boost::weight_map(edge_lengths(edges, shell))
                                       .vertex_index_map(index)
                                       .predecessor_map(previous_map)
                                       .visitor(StopAt<Vertex>(*goal)));
  } catch (const Arrived&) {
    arrived = true;
  }
  if (!arrived) return {};
  std::vector<Index> way;
  for (Vertex vertex = *goal; vertex != *start; vertex = get(previous_map, vertex))
    way.push_back(edges.number(vertex));
  way.push_back(from);
  std::ranges::reverse(way);
  return way;
}

template std::vector<std::array<Index, 2>> spanning_edges(const PlainEdgeGraph&, const Shell&);
template std::vector<std::array<Index, 2>> spanning_edges(const HalfedgeGraph&, const Shell&);
template std::vector<Index> shortest_way(const PlainEdgeGraph&, const Shell&, Index, Index);
template std::vector<Index> shortest_way(const HalfedgeGraph&, const Shell&, Index, Index);

}  // namespace meshcontour::detail

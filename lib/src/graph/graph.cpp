#include "meshcontour/graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "graph/edge_graph.hpp"

namespace meshcontour {

using namespace detail;

namespace {

double length_of(const Shell& shell, const std::vector<Index>& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i)
    length += (shell.points[path[i]] - shell.points[path[i - 1]]).norm();
  return length;
}

// Joins the edges of a forest to paths that end where it ends or branches. Every edge stands in it both ways,
// sorted by its start, so that the edges at a vertex are a run.
class ForestPaths {
 public:
  explicit ForestPaths(const std::vector<std::array<Index, 2>>& edges) {
    for (const auto& [from, to] : edges) {
      edges_.push_back({from, to});
      edges_.push_back({to, from});
    }
    std::ranges::sort(edges_);
    used_.resize(edges_.size(), false);
  }

  std::vector<std::vector<Index>> paths() && {
    std::vector<std::vector<Index>> result;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      if (!used_[i] && run(edges_[i][0]).size() != 2) result.push_back(follow(i));
    }
    return result;
  }

 private:
  std::span<const std::array<Index, 2>> run(Index vertex) const {
    const auto begin = std::ranges::lower_bound(edges_, std::array<Index, 2>{vertex, 0});
    auto end = begin;
    while (end != edges_.end() && (*end)[0] == vertex) ++end;
    return {begin, end};
  }

  std::vector<Index> follow(std::size_t edge) {
    std::vector<Index> path = {edges_[edge][0]};
    while (true) {
      const auto [from, to] = edges_[edge];
      path.push_back(to);
      used_[edge] = true;
      used_[place(to, from)] = true;
      const auto onward = run(to);
      if (onward.size() != 2) return path;
      edge = place(to, onward[0][1] == from ? onward[1][1] : onward[0][1]);
    }
  }

  std::size_t place(Index from, Index to) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(edges_, std::array<Index, 2>{from, to}) -
                                    edges_.begin());
  }

  std::vector<std::array<Index, 2>> edges_;
  std::vector<bool> used_;
};

}  // namespace

EdgePaths minimum_spanning_tree(const Shell& shell, std::size_t patch) {
  if (patch >= shell.patches.size()) {
    throw Error(ErrorCode::Usage,
                fmt::format("there is no patch {}: the shell has {}", patch + 1, shell.patches.size()));
  }
  HalfedgePatch halfedges = to_surface_mesh(shell, patch);
  const auto edges = holds_all_edges(halfedges)
                         ? spanning_edges(HalfedgeGraph(std::move(halfedges)), shell)
                         : spanning_edges(PlainEdgeGraph(shell.patch_triangles(patch)), shell);
  EdgePaths tree{ForestPaths(edges).paths(), 0};
  for (const std::vector<Index>& path : tree.paths) tree.length += length_of(shell, path);
  return tree;
}

EdgePaths shortest_path(const Shell& shell, Index from, Index to) {
  for (const Index end : {from, to}) {
    if (end >= shell.points.size()) {
      throw Error(ErrorCode::Usage, fmt::format("there is no vertex {}: the shell has {}, numbered from 0",
                                                end, shell.points.size()));
    }
    const auto uses = [&](const Triangle& t) { return std::ranges::find(t, end) != t.end(); };
    if (std::ranges::none_of(shell.triangles, uses)) {
      throw Error(ErrorCode::Usage, fmt::format("no triangle uses vertex {}", end));
    }
  }
  if (from == to) return {};
  HalfedgePatch halfedges = to_surface_mesh(shell);
  std::vector<Index> way = holds_all_edges(halfedges)
                               ? shortest_way(HalfedgeGraph(std::move(halfedges)), shell, from, to)
                               : shortest_way(PlainEdgeGraph(shell.triangles), shell, from, to);
  if (way.empty())
    throw Error(ErrorCode::Usage, fmt::format("no edges join the vertices {} and {}", from, to));
  const double length = length_of(shell, way);
  return {{std::move(way)}, length};
}

std::vector<Polyline> placed_lines(const Model& model, std::size_t shell, const EdgePaths& lines,
                                   const std::string& name) {
  std::vector<Polyline> result;
  for (const Instance& instance : model.instances) {
    if (instance.shell != shell) continue;
    for (const std::vector<Index>& path : lines.paths) {
      Polyline line{name, {}};
      for (const Index vertex : path)
        line.points.push_back(instance.placement * model.shells[shell].points[vertex]);
      result.push_back(std::move(line));
    }
  }
  return result;
}

namespace {

void note_length(Model& model, const std::string& what, double length) {
  model.diagnostics.push_back(
      {Diagnostic::Severity::Note, fmt::format("{}, length {:.9g}", what, length), {}, 1});
}

void append(std::vector<Polyline>& lines, std::vector<Polyline> more) {
  lines.insert(lines.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

std::size_t chosen_shell(const Model& model, const std::string& id) {
  if (id.empty() && model.shells.size() == 1) return 0;
  if (id.empty()) {
    throw Error(ErrorCode::Usage,
                fmt::format("a path needs --shell ID: the model has {} shells, each with vertices "
                            "of its own",
                            model.shells.size()));
  }
  const auto found = std::ranges::find(model.shells, id, &Shell::id);
  if (found == model.shells.end()) {
    throw Error(ErrorCode::Usage, fmt::format("the model has no shell '{}'", printable(id)));
  }
  return static_cast<std::size_t>(found - model.shells.begin());
}

}  // namespace

void add_trees(Model& model) {
  double length = 0;
  std::size_t patches = 0;
  for (std::size_t s = 0; s < model.shells.size(); ++s) {
    const Shell& shell = model.shells[s];
    for (std::size_t p = 0; p < shell.patches.size(); ++p) {
      if (shell.patches[p].triangle_count == 0) continue;
      const EdgePaths tree = minimum_spanning_tree(shell, p);
      append(model.tree,
             placed_lines(model, s, tree, fmt::format("shell_{}_patch_{}_tree", shell.id, p + 1)));
      length += tree.length;
      ++patches;
    }
  }
  note_length(model, fmt::format("spanning trees of {} patches", patches), length);
}

void add_path(Model& model, const std::string& id, Index from, Index to) {
  const std::size_t s = chosen_shell(model, id);
  const EdgePaths path = shortest_path(model.shells[s], from, to);
  const std::string name = fmt::format("shell_{}_path_{}_{}", model.shells[s].id, from, to);
  append(model.path, placed_lines(model, s, path, name));
  const std::size_t edges = path.paths.empty() ? 0 : path.paths[0].size() - 1;
  note_length(model, fmt::format("path from vertex {} to {}: {} edges", from, to, edges), path.length);
}

}  // namespace meshcontour

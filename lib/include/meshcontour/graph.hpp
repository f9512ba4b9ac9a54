#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "meshcontour/model.hpp"

namespace meshcontour {

/// Lines along the edges of a shell.
struct EdgePaths {
  std::vector<std::vector<Index>> paths;  ///< vertices of the shell, two or more each
  double length = 0;                      ///< of all together, model units
};

/// The minimum spanning tree of a patch's edges by their length, a tree for each of its components, by
/// Kruskal's algorithm [Kruskal 1956]. As a cut along it opens the patch with the least new boundary, and as
/// lines from vertex to vertex it reaches all of them; paths meet only where the tree branches. O(E log E).
///
/// @throws Error  Usage if there is no such patch.
EdgePaths minimum_spanning_tree(const Shell& shell, std::size_t patch);

/// The shortest way between two vertices along edges of the shell, over all its patches, by Dijkstra's
/// algorithm [Dijkstra 1959]; one path from `from` to `to`, none where they are equal. O(E + V log V).
///
/// @throws Error  Usage if no triangle uses one of the vertices, or no edges join them.
EdgePaths shortest_path(const Shell& shell, Index from, Index to);

/// Gives a model the spanning trees of all its patches, placed, as Model::tree, and notes how long they are.
void add_trees(Model& model);

/// Gives a model the shortest path between two vertices of a shell, placed, as Model::path, and notes how
/// long it is.
///
/// @param shell   the id of a shell; may be empty where there is only one.
/// @throws Error  Usage as above, or if it is not clear which shell is meant.
void add_path(Model& model, const std::string& shell, Index from, Index to);

/// The lines as they stand in every instance of the shell, in the frame of the model: for Model::annotations,
/// which pictures and geometry files show, and for write_lines. Each gets the name given.
std::vector<Polyline> placed_lines(const Model& model, std::size_t shell, const EdgePaths& lines,
                                   const std::string& name);

}  // namespace meshcontour

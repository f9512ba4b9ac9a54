#pragma once

#include <span>
#include <vector>

#include "meshcontour/wavelet.hpp"
#include "multires/fitting.hpp"
#include "multires/level.hpp"

namespace meshcontour::detail {

/// A mesh with subdivision connectivity, and the meshes between its base and itself that are fine only where
/// it needs it.
///
/// Edge e of level j is active when its odd vertex is wanted. The active edges of a set are closed: where one
/// is active so are the three edges of the parent of each triangle beside it, so that neighbours differ by
/// one level at most and no vertex lies inside an edge.
class AdaptiveMesh {
 public:
  using ActiveEdges = std::vector<std::vector<bool>>;  ///< by level, by edge

  /// @param points  of the finest level, in its order.
  /// @param kept    vertices of the finest level that every set holds.
  AdaptiveMesh(const SubdivisionConnectivity& connectivity, std::span<const Point> points,
               const std::vector<bool>& kept);

  /// Each edge's distance to the surface, the largest of all that hang on it: the edges with at least a given
  /// one are closed, and those with a larger one are among them. Inside smooth parts a shift within the
  /// surface counts a tenth.
  const std::vector<std::vector<double>>& errors() const { return errors_; }

  /// The edges whose errors are at least `error`, all of them where it is 0.
  ActiveEdges edges_above(double error) const;

  /// The smallest error at which there are no more than so many triangles.
  double error_for(std::size_t triangles) const;

  /// Makes a set closed.
  void close(ActiveEdges& active) const;

  /// The triangles of a closed set, as vertices of the finest level, in the order of the base's.
  ///
  /// @param first  one a triangle of the base and one more: where its triangles begin.
  std::vector<Triangle> triangles(const ActiveEdges& active, std::vector<std::size_t>& first) const;

  /// Positions for the vertices of a closed set: those on sharp edges stay, the others go where the squared
  /// distances of the finest vertices to their places on the triangles, by their share of the surface, have
  /// the least sum.
  ///
  /// @return  one a vertex of the finest level; those that are not in the set are of no use.
  std::vector<Point> fitted(const ActiveEdges& active) const;

  const std::vector<MeshLevel>& levels() const { return levels_; }

 private:
  struct Leaf;
  void measure(const std::vector<bool>& kept);
  void saturate();
  template <class Visit>
  void for_each_parent(std::size_t j, Index edge, Visit&& visit) const;
  template <class Visit>
  void for_each_leaf(const ActiveEdges& active, Visit&& visit) const;
  Leaf leaf_of(const ActiveEdges& active, std::size_t j, Index face) const;
  void place(const Leaf& leaf, std::size_t level, Index face, std::vector<VertexMean>& means) const;

  std::vector<MeshLevel> levels_;
  std::vector<Point> points_;
  std::vector<std::vector<double>> errors_;
};

}  // namespace meshcontour::detail

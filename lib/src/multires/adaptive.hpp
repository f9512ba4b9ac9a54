#pragma once

#include <span>
#include <vector>

#include "meshcontour/wavelet.hpp"
#include "multires/level.hpp"

namespace meshcontour::detail {

/// What an edge that is not cut costs.
enum class EdgeMeasure {
  Distance,  ///< the distance of its odd vertex
  Integral,  ///< that times its length: the root of the squared distance over the surface around
};

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
               const std::vector<bool>& kept, EdgeMeasure measure = EdgeMeasure::Distance);

  /// Each edge's error, the largest of all that hang on it: the edges with at least a given
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

  const std::vector<MeshLevel>& levels() const { return levels_; }

 private:
  struct Leaf;
  void measure(const std::vector<bool>& kept, EdgeMeasure measure);
  void saturate();
  template <class Visit>
  void for_each_parent(std::size_t j, Index edge, Visit&& visit) const;
  template <class Visit>
  void for_each_leaf(const ActiveEdges& active, Visit&& visit) const;
  Leaf leaf_of(const ActiveEdges& active, std::size_t j, Index face) const;

  std::vector<MeshLevel> levels_;
  std::vector<Point> points_;
  std::vector<std::vector<double>> errors_;
};

}  // namespace meshcontour::detail

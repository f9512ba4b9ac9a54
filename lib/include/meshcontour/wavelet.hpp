#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "meshcontour/subdivision.hpp"

namespace meshcontour {

/// A mesh as the result of quadrisections.
struct SubdivisionConnectivity {
  unsigned levels = 0;  ///< 0: it is none, and the rest is empty
  Shell base;  ///< the coarsest mesh, with the patches; points in the order in which the shell has them
  std::vector<Index> order;  ///< vertex i of subdivided(base, levels) is this vertex of the shell
};

/// Finds out whether the triangles of a shell, in whatever order, come from subdivisions [Taubin 2002];
/// linear.
///
/// The four children of a triangle must be of one patch. Shells that are no orientable manifold, or with
/// parts of which just some were subdivided, give 0 levels. Creases inside patches do not matter, and the
/// base has none. Where a part has several coarser meshes (a regular torus, a strip) the first that is found
/// counts.
SubdivisionConnectivity find_subdivision(const Shell& shell);

/// The length of the wavelet coefficient of each point of a shell, 0 at those of the coarsest mesh; nothing
/// if the shell comes from no subdivision.
std::vector<double> detail_sizes(const Shell& shell, const SubdivisionOptions& options = {});

/// A lifted butterfly wavelet transform on the meshes that a base mesh gives by quadrisection.
///
/// Level 0 is the base mesh; level j+1 has the vertices of level j first (even) and then one for each of its
/// edges (odd), as in subdivided(). Prediction is the modified butterfly rule, the update keeps the mean of
/// the surface and moves border vertices by border details only. [Schroeder & Sweldens 1995]
class WaveletTransform {
 public:
  /// @param base    triangles of an orientable manifold, `vertex_count` vertices.
  /// @param levels  steps of refinement, at least 1.
  /// @throws Error  as subdivided().
  WaveletTransform(std::span<const Triangle> base, Index vertex_count, unsigned levels,
                   const SubdivisionOptions& options = {});
  /// As above, with the borders of the base's patches as curves of their own if the options say so.
  WaveletTransform(const Shell& base, unsigned levels, const SubdivisionOptions& options = {});
  ~WaveletTransform();

  unsigned levels() const;
  /// Vertices of a level, 0 to levels().
  Index vertex_count(unsigned level) const;
  std::span<const Triangle> triangles(unsigned level) const;

  /// Integrals of the scaling functions of a level, in units of the finest triangle's area.
  std::span<const double> integrals(unsigned level) const;

  /// Vertices at which the update had to be left out, summed over the levels; the mean is kept exactly when
  /// 0.
  std::size_t unlifted() const;

  /// Fine positions to coarse ones and details, in place: afterwards the first vertex_count(0) entries are
  /// the coarse mesh, and entries vertex_count(j) .. vertex_count(j+1) - 1 the details of level j. Linear.
  ///
  /// @param points  vertex_count(levels()).
  void analyse(std::span<Point> points) const;

  /// The inverse, in place.
  void synthesise(std::span<Point> points) const;

  /// One step of it: from the points of a level and its details behind them to the points of the next.
  void synthesise(unsigned level, std::span<Point> points) const;

  /// Directions in which the details of a level matter: columns are the normal and two tangents of what their
  /// vertices are predicted to be, the tangents four times as long, as shifts within the surface matter less
  /// [Khodakovsky, Schroeder & Sweldens 2000]; the axes at borders and other sharp edges.
  ///
  /// @param points  of the level.
  /// @return        one an edge of the level; columns are perpendicular.
  std::vector<Eigen::Matrix3d> detail_frames(unsigned level, std::span<const Point> points) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace meshcontour

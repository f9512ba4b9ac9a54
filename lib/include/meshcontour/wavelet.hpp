#pragma once

#include <memory>
#include <span>
#include <vector>

#include "meshcontour/subdivision.hpp"

namespace meshcontour {


/// A lifted butterfly wavelet transform on the meshes that a base mesh gives by quadrisection.
///
/// Level 0 is the base mesh; level j+1 has the vertices of level j first (even) and then one for each of its edges
/// (odd), as in subdivided(). Prediction is the modified butterfly rule, the update keeps the mean of the surface and
/// moves border vertices by border details only. [Schroeder & Sweldens 1995]
class WaveletTransform {
 public:
  /// @param base    triangles of an orientable manifold, `vertex_count` vertices.
  /// @param levels  steps of refinement, at least 1.
  /// @throws Error  as subdivided().
  WaveletTransform(std::span<const Triangle> base, Index vertex_count, unsigned levels,
                   const SubdivisionOptions& options = {});
  ~WaveletTransform();

  unsigned levels() const;
  /// Vertices of a level, 0 to levels().
  Index vertex_count(unsigned level) const;
  std::span<const Triangle> triangles(unsigned level) const;

  /// Integrals of the scaling functions of a level, in units of the finest triangle's area.
  std::span<const double> integrals(unsigned level) const;

  /// Vertices at which the update had to be left out, summed over the levels; the mean is kept exactly when 0.
  std::size_t unlifted() const;

  /// Fine positions to coarse ones and details, in place: afterwards the first vertex_count(0) entries are the coarse
  /// mesh, and entries vertex_count(j) .. vertex_count(j+1) - 1 the details of level j. Linear.
  ///
  /// @param points  vertex_count(levels()).
  void analyse(std::span<Point> points) const;

  /// The inverse, in place.
  void synthesise(std::span<Point> points) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace meshcontour

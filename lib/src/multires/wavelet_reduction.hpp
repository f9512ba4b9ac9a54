#pragma once

#include "multires/adaptive.hpp"

namespace meshcontour::detail {

/// Simpler meshes of a shell that was subdivided: coarse where its details are small.
///
/// Details are chosen by their errors; then vertices and edges of the mesh that they give are fitted to the
/// shell, borders and edges between patches aside, and vertices that are of no use any more are taken out.
class WaveletReduction {
 public:
  /// @param shell    outlives this.
  /// @param surface  to which to fit, patch by patch: the shell or what it stands for; outlives this.
  /// @param measure  by which details are chosen: Distance where the largest distance counts, Integral where
  ///                 the number of triangles does.
  WaveletReduction(const Shell& shell, const Shell& surface, const SubdivisionConnectivity& connectivity,
                   EdgeMeasure measure, unsigned threads);

  unsigned levels() const { return static_cast<unsigned>(mesh_.levels().size() - 1); }

  /// All details of at least so large an error stay.
  Shell within(double error) const;

  /// The largest details stay, so many that there are no more triangles, if the coarsest mesh has no more.
  Shell with(std::size_t triangles) const;

 private:
  Shell chosen(double error) const;

  const Shell& shell_;
  const Shell& surface_;
  Shell base_;
  std::vector<Index> order_;
  AdaptiveMesh mesh_;
  unsigned threads_;
};

}  // namespace meshcontour::detail

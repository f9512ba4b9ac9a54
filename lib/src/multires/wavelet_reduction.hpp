#pragma once

#include "multires/adaptive.hpp"

namespace meshcontour::detail {

/// Simpler meshes of a shell that was subdivided: coarse where its details are small.
class WaveletReduction {
 public:
  WaveletReduction(const Shell& shell, const SubdivisionConnectivity& connectivity);

  unsigned levels() const { return static_cast<unsigned>(mesh_.levels().size() - 1); }

  /// All details of at least so large an error stay.
  Shell within(double error) const;

  /// The largest details stay, so many that there are no more triangles, if the coarsest mesh has no more.
  Shell with(std::size_t triangles) const { return within(mesh_.error_for(triangles)); }

 private:
  Shell shell_of(const std::vector<Point>& points, const std::vector<Triangle>& triangles,
                 const std::vector<std::size_t>& first) const;

  Shell base_;
  std::vector<Index> order_;
  AdaptiveMesh mesh_;
};

}  // namespace meshcontour::detail

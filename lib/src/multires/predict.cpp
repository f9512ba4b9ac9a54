#include "multires/predict.hpp"

#include "meshcontour/parallel.hpp"
#include "multires/stencil.hpp"

namespace meshcontour::detail {

void add_prediction(const MeshLevel& level, const SubdivisionOptions& options, double sign,
                    std::span<Point> points) {
  constexpr std::size_t kGrain = 1 << 14;
  const Stencils stencils(level, options.boundary);
  parallel_for(level.edge_count(), kGrain, options.threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Stencils::Term> terms;
    for (std::size_t e = begin; e < end; ++e) {
      stencils.of_edge(static_cast<Index>(e), terms);
      Point sum = Point::Zero();
      for (const auto& [vertex, weight] : terms) sum += weight * points[vertex];
      points[level.vertex_count + e] += sign * sum;
    }
  });
}

}  // namespace meshcontour::detail

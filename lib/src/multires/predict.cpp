#include "multires/predict.hpp"

#include "meshcontour/parallel.hpp"
#include "multires/hub.hpp"

namespace meshcontour::detail {
namespace {

// In the order of Stencils::of_edge(), so that both give the same bits.
Point regular_sum(const Stencils::Regular& at, std::span<const Point> points) {
  Point sum = Point::Zero();
  for (std::size_t i = 0; i < 2; ++i) sum += Stencils::kEnd * points[at[i]];
  for (std::size_t i = 2; i < 4; ++i) sum += Stencils::kOpposite * points[at[i]];
  for (std::size_t i = 4; i < 8; ++i) sum += Stencils::kWing * points[at[i]];
  return sum;
}

Point general_sum(const std::vector<Stencils::Term>& terms, std::span<const Point> points) {
  Point sum = Point::Zero();
  for (const auto& [vertex, weight] : terms) sum += weight * points[vertex];
  return sum;
}

}  // namespace

void add_prediction(const MeshLevel& level, const SubdivisionOptions& options, double sign,
                    std::span<Point> points) {
  constexpr std::size_t kGrain = 1 << 14;
  const Stencils stencils(level, options.boundary);
  parallel_for(level.edge_count(), kGrain, options.threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Stencils::Term> terms;
    for (std::size_t e = begin; e < end; ++e) {
      const auto regular = stencils.regular(static_cast<Index>(e));
      Point& odd = points[level.vertex_count + e];
      if (regular) {
        odd += sign * regular_sum(*regular, points);
        continue;
      }
      stencils.of_edge(static_cast<Index>(e), terms);
      odd += sign * general_sum(terms, points);
    }
  });
  add_hub_predictions(stencils, sign, points);
}

}  // namespace meshcontour::detail

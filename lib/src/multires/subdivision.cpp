#include "meshcontour/subdivision.hpp"

#include <fmt/format.h>

#include <limits>

#include "multires/hub.hpp"
#include "multires/level.hpp"
#include "multires/predict.hpp"

namespace meshcontour {
namespace {

using detail::MeshLevel;

// Corner normals of the children, the new ones half way between their parent's corners.
std::vector<Vector> refined_normals(const std::vector<Vector>& normals) {
  std::vector<Vector> out;
  out.reserve(4 * normals.size());
  const auto between = [](const Vector& a, const Vector& b) -> Vector { return (a + b).stableNormalized(); };
  for (std::size_t i = 0; i + 2 < normals.size(); i += 3) {
    const Vector &a = normals[i], &b = normals[i + 1], &c = normals[i + 2];
    const Vector p = between(a, b), q = between(b, c), r = between(c, a);
    for (const Vector& n : {a, p, r, p, b, q, r, q, c, p, q, r}) out.push_back(n);
  }
  return out;
}

// A value a point; new points get theirs by the rule for attributes.
template <typename Value>
void refine(const MeshLevel& level, const SubdivisionOptions& options, std::vector<Value>& values) {
  if (values.empty()) return;
  values.reserve(values.size() + level.edge_count());
  const detail::Stencils stencils(level, options.boundary);
  std::vector<detail::Stencils::Term> terms;
  for (Index e = 0; e < level.edge_count(); ++e) {
    const Index h = level.first_halfedge[e];
    Value value = 0.5 * (values[level.start(h)] + values[level.end(h)]);
    if (options.attributes == AttributeRule::Butterfly) {
      stencils.of_edge(e, terms);
      value.setZero();
      for (const auto& [vertex, weight] : terms) value += weight * values[vertex];
    }
    values.push_back(value);
  }
  if (options.attributes == AttributeRule::Butterfly) {
    detail::add_hub_predictions(stencils, 1, std::span<Value>(values));
  }
}

}  // namespace

Shell subdivided(const Shell& shell, unsigned levels, const SubdivisionOptions& options) {
  Shell fine = shell;
  if (levels == 0) return fine;
  fine.polygons = {};
  fine.creases.clear();  // inside patches all becomes smooth
  MeshLevel level = detail::make_level(shell, options.creases);
  for (unsigned step = 0; step < levels; ++step) {
    if (fine.points.size() + level.edge_count() > std::numeric_limits<Index>::max() / 6) {
      throw Error(ErrorCode::Usage,
                  fmt::format("shell {}: {} subdivisions give too many points", printable(shell.id), levels));
    }
    fine.points.resize(level.vertex_count + level.edge_count(), Point::Zero());
    detail::add_prediction(level, options, 1, fine.points);
    refine(level, options, fine.point_colors);
    for (Eigen::Vector4d& color : fine.point_colors) color = color.cwiseMax(0).cwiseMin(1);
    refine(level, options, fine.texture_coordinates);
    if (step + 1 == levels) {
      fine.triangles = detail::quadrisected_triangles(level);
    } else {
      level = detail::quadrisected(level);
    }
    fine.corner_normals = refined_normals(fine.corner_normals);
    for (Patch& patch : fine.patches) {
      patch.first_triangle *= 4;
      patch.triangle_count *= 4;
    }
  }
  return fine;
}

}  // namespace meshcontour

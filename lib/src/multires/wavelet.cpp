#include "meshcontour/wavelet.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "multires/hub.hpp"
#include "multires/level.hpp"
#include "multires/predict.hpp"

namespace meshcontour {
namespace {

using detail::MeshLevel;
using detail::Stencils;

constexpr double kTangentialStep = 4;    // beside one along the normal
constexpr double kPerpendicular = 1e-6;  // what squares of lengths may be off

// What the detail of an edge adds to an even vertex.
struct Lift {
  Index vertex = MeshLevel::kNone;
  double weight = 0;
};

bool on_border(const MeshLevel& level, Index v) {
  return level.sharp_edges[v] > 0;
}

// Even vertices that a detail may move: border details move border vertices, inner ones inner vertices.
std::array<Index, 2> lifted_vertices(const MeshLevel& level, Index edge) {
  const Index h = level.first_halfedge[edge];
  const Index u = level.start(h), v = level.end(h);
  if (level.sharp[edge] || (!on_border(level, u) && !on_border(level, v))) return {u, v};
  std::array<Index, 2> candidates = {u, v};
  if (on_border(level, u) && on_border(level, v)) {
    candidates = {level.opposite(h), level.opposite(level.twins[h])};
  }
  for (Index& candidate : candidates) {
    if (on_border(level, candidate)) candidate = MeshLevel::kNone;
  }
  return candidates;
}

}  // namespace

struct WaveletTransform::Implementation {
  SubdivisionOptions options;
  std::vector<MeshLevel> levels;                        // 0..J
  std::vector<std::vector<double>> integrals;           // 0..J
  std::vector<std::vector<std::array<Lift, 2>>> lifts;  // 0..J-1, one an edge
  std::size_t unlifted = 0;

  void refine(MeshLevel base, unsigned count) {
    levels.push_back(std::move(base));
    for (unsigned j = 0; j < count; ++j) levels.push_back(detail::quadrisected(levels.back()));
    integrate();
    find_lifts();
  }

  // Finest: a third of the triangles around; coarser: even + S^T odd.
  void integrate() {
    integrals.resize(levels.size());
    std::vector<double>& finest = integrals.back();
    finest.assign(levels.back().vertex_count, 0);
    for (const Triangle& t : levels.back().triangles) {
      for (const Index v : t) finest[v] += 1;
    }
    for (double& value : finest) value /= 3;
    std::vector<Stencils::Term> terms;
    for (std::size_t j = levels.size() - 1; j-- > 0;) {
      const MeshLevel& level = levels[j];
      const Stencils stencils(level, options.boundary);
      integrals[j].assign(integrals[j + 1].begin(), integrals[j + 1].begin() + level.vertex_count);
      for (Index e = 0; e < level.edge_count(); ++e) {
        stencils.of_edge(e, terms);
        for (const auto& [vertex, weight] : terms) {
          integrals[j][vertex] += weight * integrals[j + 1][level.vertex_count + e];
        }
      }
      detail::add_hub_transposed(stencils, integrals[j + 1], integrals[j]);
    }
  }

  std::array<Lift, 2> lift_of(std::size_t j, Index edge) const {
    std::array<Index, 2> vertices = lifted_vertices(levels[j], edge);
    for (Index& v : vertices) {
      if (v != MeshLevel::kNone && integrals[j][v] <= 0) v = MeshLevel::kNone;
    }
    const double odd = integrals[j + 1][levels[j].vertex_count + edge];
    const auto share = static_cast<double>(2 - std::ranges::count(vertices, MeshLevel::kNone));
    std::array<Lift, 2> lift;
    for (std::size_t k = 0; k < 2; ++k) {
      if (vertices[k] != MeshLevel::kNone) lift[k] = {vertices[k], odd / (share * integrals[j][vertices[k]])};
    }
    return lift;
  }

  void find_lifts() {
    lifts.resize(levels.size() - 1);
    for (std::size_t j = 0; j < lifts.size(); ++j) {
      lifts[j].resize(levels[j].edge_count());
      for (Index e = 0; e < lifts[j].size(); ++e) {
        lifts[j][e] = lift_of(j, e);
        if (std::ranges::all_of(lifts[j][e], [](const Lift& l) { return l.vertex == MeshLevel::kNone; }))
          ++unlifted;
      }
    }
  }

  // Adds the details of a level to its even points, scaled by `sign`; in edge order, so that sums are the
  // same always.
  void update(std::size_t j, std::span<Point> points, double sign) const {
    const Index even = levels[j].vertex_count;
    for (std::size_t e = 0; e < lifts[j].size(); ++e) {
      for (const Lift& lift : lifts[j][e]) {
        if (lift.vertex != MeshLevel::kNone) points[lift.vertex] += sign * lift.weight * points[even + e];
      }
    }
  }
};

WaveletTransform::WaveletTransform(std::span<const Triangle> base, Index vertex_count, unsigned levels,
                                   const SubdivisionOptions& options)
    : implementation_(std::make_unique<Implementation>()) {
  implementation_->options = options;
  implementation_->refine(
      detail::make_level(base, vertex_count, [](std::size_t, std::size_t) { return false; }), levels);
}

WaveletTransform::WaveletTransform(const Shell& base, unsigned levels, const SubdivisionOptions& options)
    : implementation_(std::make_unique<Implementation>()) {
  implementation_->options = options;
  implementation_->refine(detail::make_level(base, options.creases), levels);
}

WaveletTransform::~WaveletTransform() = default;

unsigned WaveletTransform::levels() const {
  return static_cast<unsigned>(implementation_->lifts.size());
}

Index WaveletTransform::vertex_count(unsigned level) const {
  return implementation_->levels[level].vertex_count;
}

std::span<const Triangle> WaveletTransform::triangles(unsigned level) const {
  return implementation_->levels[level].triangles;
}

std::span<const double> WaveletTransform::integrals(unsigned level) const {
  return implementation_->integrals[level];
}

std::size_t WaveletTransform::unlifted() const {
  return implementation_->unlifted;
}

std::vector<double> detail_sizes(const Shell& shell, const SubdivisionOptions& options) {
  const SubdivisionConnectivity connectivity = find_subdivision(shell);
  if (connectivity.levels == 0) return {};
  std::vector<Point> points(connectivity.order.size());
  for (std::size_t v = 0; v < points.size(); ++v) points[v] = shell.points[connectivity.order[v]];
  WaveletTransform(connectivity.base, connectivity.levels, options).analyse(points);
  std::vector<double> sizes(shell.points.size(), 0);
  for (std::size_t v = connectivity.base.points.size(); v < points.size(); ++v) {
    sizes[connectivity.order[v]] = points[v].norm();
  }
  return sizes;
}

void WaveletTransform::analyse(std::span<Point> points) const {
  for (std::size_t j = levels(); j-- > 0;) {
    const std::span<Point> fine = points.first(implementation_->levels[j + 1].vertex_count);
    detail::add_prediction(implementation_->levels[j], implementation_->options, -1, fine);
    implementation_->update(j, fine, 1);
  }
}

void WaveletTransform::synthesise(std::span<Point> points) const {
  for (unsigned j = 0; j < levels(); ++j) synthesise(j, points.first(vertex_count(j + 1)));
}

void WaveletTransform::synthesise(unsigned level, std::span<Point> points) const {
  implementation_->update(level, points, -1);
  detail::add_prediction(implementation_->levels[level], implementation_->options, 1, points);
}

std::vector<Eigen::Matrix3d> WaveletTransform::detail_frames(unsigned level,
                                                             std::span<const Point> points) const {
  const MeshLevel &coarse = implementation_->levels[level], &fine = implementation_->levels[level + 1];
  std::vector<Point> predicted(points.begin(), points.begin() + coarse.vertex_count);
  predicted.resize(fine.vertex_count, Point::Zero());
  detail::add_prediction(coarse, implementation_->options, 1, predicted);
  std::vector<Vector> normals(coarse.edge_count(), Vector::Zero());
  for (const auto& [a, b, c] : fine.triangles) {
    const Vector normal = (predicted[b] - predicted[a]).cross(predicted[c] - predicted[a]);
    for (const Index v : {a, b, c}) {
      if (v >= coarse.vertex_count) normals[v - coarse.vertex_count] += normal;
    }
  }
  std::vector<Eigen::Matrix3d> frames(coarse.edge_count(), Eigen::Matrix3d::Identity());
  for (Index e = 0; e < frames.size(); ++e) {
    const Index h = coarse.first_halfedge[e];
    const Vector normal = normals[e].stableNormalized();
    const Vector side = predicted[coarse.end(h)] - predicted[coarse.start(h)];
    const Vector tangent = (side - side.dot(normal) * normal).stableNormalized();
    if (coarse.sharp[e] || !(std::abs(normal.cross(tangent).squaredNorm() - 1) < kPerpendicular)) continue;
    frames[e] << normal, kTangentialStep * tangent, kTangentialStep * normal.cross(tangent);
  }
  return frames;
}

}  // namespace meshcontour

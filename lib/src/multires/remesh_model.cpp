#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "meshcontour/parallel.hpp"
#include "meshcontour/remeshing.hpp"

namespace meshcontour {
namespace {

// What became of a shell: nothing to do, a remesh with its note, or a note why there is none.
struct Outcome {
  std::optional<Remesh> remesh;
  std::optional<Diagnostic> note;
};

Outcome outcome_of(const Shell& shell, const RemeshOptions& options) {
  Outcome out;
  if (shell.triangles.empty() || find_subdivision(shell).levels > 0) return out;
  Spot spot;
  spot.element = fmt::format("shell {}", printable(shell.id));
  try {
    Remesh remesh = remeshed(shell, options);
    out.note = {
        Diagnostic::Severity::Note,
        fmt::format("remeshed from {} to {} triangles on {} levels, at most {} apart", shell.triangles.size(),
                    remesh.shell.triangles.size(), remesh.connectivity.levels, remesh.error),
        spot};
    out.remesh = std::move(remesh);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::BadData) throw;
    out.note = {Diagnostic::Severity::Note, fmt::format("not remeshed: {}", error.what()), spot};
  }
  return out;
}

// The shares of the details that leave the surface, of each vertex of a remesh.
std::vector<double> sizes_across(const Remesh& remesh, const Shell& shell,
                                 const SubdivisionOptions& options) {
  std::vector<Point> points = remesh.shell.points;
  const SubdivisionConnectivity& connectivity = remesh.connectivity;
  WaveletTransform(connectivity.base, connectivity.levels, options).analyse(points);
  std::vector<double> sizes(points.size(), 0);
  for (std::size_t v = connectivity.base.points.size(); v < points.size(); ++v) {
    const auto [a, b, c] = shell.triangles[remesh.places[v].triangle];
    const Vector cross = (shell.points[b] - shell.points[a]).cross(shell.points[c] - shell.points[a]);
    sizes[v] = std::abs(points[v].dot(cross.stableNormalized()));
  }
  return sizes;
}

}  // namespace

ModelRemesh remeshed_model(const Model& model, const RemeshOptions& options) {
  std::vector<Outcome> outcomes(model.shells.size());
  parallel_for(outcomes.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) outcomes[s] = outcome_of(model.shells[s], options);
  });
  ModelRemesh out;
  for (Outcome& outcome : outcomes) {
    out.shells.push_back(std::move(outcome.remesh));
    if (outcome.note) out.notes.push_back(*std::move(outcome.note));
  }
  return out;
}

Model with_remeshed_shells(const Model& model, const ModelRemesh& remesh) {
  Model out = model;
  for (std::size_t s = 0; s < remesh.shells.size(); ++s) {
    if (remesh.shells[s]) out.shells[s] = remesh.shells[s]->shell;
  }
  return out;
}

std::vector<double> remeshed_detail_sizes(const Shell& shell, const Remesh& remesh,
                                          const SubdivisionOptions& subdivide) {
  constexpr double kUnknown = -1;
  const std::vector<double> across = sizes_across(remesh, shell, subdivide);
  std::vector<double> sizes(shell.points.size(), kUnknown);
  for (std::size_t v = 0; v < across.size(); ++v) {
    for (const Index corner : shell.triangles[remesh.places[v].triangle])
      sizes[corner] = std::max(sizes[corner], across[v]);
  }
  // Points that only triangles without a vertex on them have around them take from their neighbours.
  for (const Triangle& t : shell.triangles) {
    const double largest = std::max({sizes[t[0]], sizes[t[1]], sizes[t[2]], 0.0});
    for (const Index corner : t) {
      if (sizes[corner] == kUnknown) sizes[corner] = largest;
    }
  }
  for (double& size : sizes) size = std::max(size, 0.0);
  return sizes;
}

}  // namespace meshcontour

#include "meshcontour/simplification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "meshcontour/parallel.hpp"
#include "meshcontour/remeshing.hpp"
#include "multires/edge_collapse.hpp"
#include "multires/wavelet_reduction.hpp"

namespace meshcontour {
namespace {

constexpr int kTrials = 6;                             // of limits until the error holds
constexpr double kNearEnough = 0.7;                    // of the error asked for: no further trial
constexpr double kAim = 0.85;                          // of the error asked for: what the next trial aims at
constexpr double kRemeshShare = 0.5;                   // of the error asked for, left to the subdivision mesh
constexpr std::size_t kBaseShare = 4, kLeastBase = 8;  // of the triangles asked for
constexpr unsigned kLeastLevels = 2;  // of a mesh that is taken for subdivided without being told

void check(const SimplifyOptions& options) {
  const bool positive = std::isfinite(options.value) && options.value > 0;
  const bool ratio = options.goal == SimplifyGoal::Ratio;
  if (options.goal != SimplifyGoal::None && (!positive || (ratio && options.value > 1))) {
    throw Error(ErrorCode::Usage, fmt::format("simplification to {}: expected a number above zero{}",
                                              options.value, ratio ? ", at most 1" : ""));
  }
}

// Tries several limits and keeps the smallest mesh whose measured distance is no larger than asked for; the
// shell stays as it is when there is none. Returns the distance.
double reduce_within(Shell& shell, double error, unsigned threads,
                     const std::function<Shell(double)>& reduce) {
  std::optional<Shell> best;
  double limit = error, best_distance = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Shell simple = reduce(limit);
    const double distance = patch_distance(shell, simple, threads).upper;
    if (distance <= error && (!best || simple.triangles.size() < best->triangles.size())) {
      best = std::move(simple);
      best_distance = distance;
    }
    if (distance <= error && (distance >= kNearEnough * error || trial >= kTrials / 2)) break;
    limit *= std::clamp(kAim * error / std::max(distance, error / 1000), 0.1, 2.0);
  }
  if (best) shell = *std::move(best);
  return best_distance;
}

// A subdivision mesh in the place of a shell that is none, near enough for the error asked for.
Remesh remesh_for(const Shell& shell, const SimplifyOptions& options, std::size_t triangles) {
  RemeshOptions remesh_options;
  remesh_options.threads = options.threads;
  if (options.goal == SimplifyGoal::Error) {
    remesh_options.tolerance = kRemeshShare * options.value;
  } else {
    remesh_options.base_triangles =
        std::clamp(triangles / kBaseShare, kLeastBase, remesh_options.base_triangles);
  }
  Remesh remesh;
  try {
    remesh = remeshed(shell, remesh_options);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}; --simplify-method qem takes it as it is", error.what()));
  }
  if (options.goal == SimplifyGoal::Error && remesh.error > options.value) {
    throw Error(ErrorCode::BadData,
                fmt::format("shell {}: as a subdivision mesh, which the wavelet method needs, it is {} from "
                            "itself, more than the {} asked for; use --simplify-method qem",
                            printable(shell.id), remesh.error, options.value));
  }
  return remesh;
}

// The wavelet way, where the shell has one and it is wanted; through a remesh where that is needed.
std::optional<detail::WaveletReduction> wavelet_way(const Shell& shell, const SimplifyOptions& options,
                                                    std::size_t triangles, std::optional<Remesh>& remesh) {
  if (options.method == SimplifyMethod::Qem) return std::nullopt;
  // Creases would be lost; a remesh keeps them as curves.
  const SubdivisionConnectivity found =
      shell.creases.empty() ? find_subdivision(shell) : SubdivisionConnectivity{};
  const bool chosen = options.method == SimplifyMethod::Wavelet,
             largest = options.goal == SimplifyGoal::Error;
  const bool reaches = largest || found.base.triangles.size() <= triangles;
  if (!chosen && (found.levels < kLeastLevels || !reaches)) return std::nullopt;
  if (found.levels == 0) remesh = remesh_for(shell, options, triangles);
  const auto measure = largest ? detail::EdgeMeasure::Distance : detail::EdgeMeasure::Integral;
  return std::optional<detail::WaveletReduction>(std::in_place, remesh ? remesh->shell : shell, shell,
                                                 remesh ? remesh->connectivity : found, measure,
                                                 options.threads);
}

}  // namespace

Simplification simplify_shell(Shell& shell, const SimplifyOptions& options, std::size_t triangles) {
  check(options);
  Simplification result;
  result.triangles_before = result.triangles_after = shell.triangles.size();
  const bool enough = options.goal != SimplifyGoal::Error && triangles >= shell.triangles.size();
  if (options.goal == SimplifyGoal::None || shell.triangles.empty() || enough) return result;
  std::optional<Remesh> remesh;
  const auto wavelets = wavelet_way(shell, options, triangles, remesh);
  if (wavelets) {
    result.method = SimplifyMethod::Wavelet;
    result.levels = wavelets->levels();
  }
  if (remesh) {
    result.remesh_triangles = remesh->shell.triangles.size();
    result.remesh_error = remesh->error;
  }
  if (options.goal == SimplifyGoal::Error) {
    const auto reduce = [&](double limit) {
      return wavelets ? wavelets->within(limit) : detail::collapsed(shell, 0, limit, options.threads);
    };
    result.error = reduce_within(shell, options.value, options.threads, reduce);
  } else {
    constexpr double kNoLimit = std::numeric_limits<double>::infinity();
    Shell simple =
        wavelets ? wavelets->with(triangles) : detail::collapsed(shell, triangles, kNoLimit, options.threads);
    result.error = patch_distance(shell, simple, options.threads).upper;
    shell = std::move(simple);
  }
  result.triangles_after = shell.triangles.size();
  return result;
}

std::vector<Simplification> simplify_model(Model& model, const SimplifyOptions& options) {
  check(options);
  std::vector<Simplification> results;
  if (options.goal == SimplifyGoal::None) return results;
  std::size_t all = 0;
  for (const Shell& shell : model.shells) all += shell.triangles.size();
  const double share = options.goal == SimplifyGoal::Ratio || all == 0
                           ? options.value
                           : std::min(1.0, options.value / static_cast<double>(all));
  results.resize(model.shells.size());
  // Many small shells side by side; the parts of a large one too.
  parallel_for(model.shells.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      Shell& shell = model.shells[s];
      const auto triangles = static_cast<std::size_t>(share * static_cast<double>(shell.triangles.size()));
      results[s] = simplify_shell(shell, options, triangles);
      results[s].shell = s;
    }
  });
  return results;
}

}  // namespace meshcontour

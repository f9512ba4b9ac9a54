#include "meshcontour/simplification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "meshcontour/parallel.hpp"
#include "multires/edge_collapse.hpp"

namespace meshcontour {
namespace {

constexpr int kTrials = 6;           // of limits until the error holds
constexpr double kNearEnough = 0.7;  // of the error asked for: no further trial
constexpr double kAim = 0.85;        // of the error asked for: what the next trial aims at

void check(const SimplifyOptions& options) {
  const bool positive = std::isfinite(options.value) && options.value > 0;
  const bool ratio = options.goal == SimplifyGoal::Ratio;
  if (options.goal != SimplifyGoal::None && (!positive || (ratio && options.value > 1))) {
    throw Error(ErrorCode::Usage, fmt::format("simplification to {}: expected a number above zero{}",
                                              options.value, ratio ? ", at most 1" : ""));
  }
}

// Collapses with several limits and keeps the smallest mesh whose measured distance is no larger than asked
// for; the shell stays as it is when there is none.
double collapse_within(Shell& shell, double error, unsigned threads) {
  std::optional<Shell> best;
  double limit = error, best_distance = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Shell simple = detail::collapsed(shell, 0, limit, threads);
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

}  // namespace

Simplification simplify_shell(Shell& shell, const SimplifyOptions& options, std::size_t triangles) {
  check(options);
  Simplification result;
  result.triangles_before = result.triangles_after = shell.triangles.size();
  if (options.goal == SimplifyGoal::None) return result;
  if (options.method == SimplifyMethod::Wavelet) {
    throw Error(ErrorCode::BadData,
                fmt::format("shell {}: its triangles are not known to come from a subdivision; use "
                            "--simplify-method qem",
                            printable(shell.id)));
  }
  if (options.goal == SimplifyGoal::Error) {
    result.error = collapse_within(shell, options.value, options.threads);
  } else if (triangles < shell.triangles.size()) {
    Shell simple =
        detail::collapsed(shell, triangles, std::numeric_limits<double>::infinity(), options.threads);
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

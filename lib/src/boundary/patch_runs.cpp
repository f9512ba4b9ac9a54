#include "boundary/patch_runs.hpp"

#include "meshcontour/parallel.hpp"

namespace meshcontour::detail {
namespace {

struct Run {
  std::size_t shell, first, last;
};

// A patch costs about as much as 8 triangles, even an empty one.
constexpr std::size_t kPatchCost = 8;
constexpr std::size_t kRunCost = 8192;

}  // namespace

void for_each_patch(const Model& model, unsigned threads,
                    const std::function<void(std::size_t, std::size_t, std::size_t)>& body) {
  std::vector<Run> runs;
  for (std::size_t shell = 0; shell < model.shells.size(); ++shell) {
    const auto& patches = model.shells[shell].patches;
    std::size_t first = 0, cost = 0;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      cost += patches[i].triangle_count + kPatchCost;
      if (cost < kRunCost && i + 1 < patches.size()) continue;
      runs.push_back({shell, first, i + 1});
      first = i + 1;
      cost = 0;
    }
  }
  parallel_for(runs.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(runs[i].shell, runs[i].first, runs[i].last);
  });
}

}  // namespace meshcontour::detail

#include "fuzz/targets.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace fuzz {

Target find_target(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, Target>, 13> kTargets = {
      {{"webxml", read_webxml_both_ways},
       {"swp", read_swp},
       {"stl", read_stl},
       {"obj", read_obj},
       {"ply", read_ply},
       {"off", read_off},
       {"net", read_net},
       {"wavelet", read_wavelet},
       {"files", read_files},
       {"numbers", scan_numbers},
       {"loops", trace_loops},
       {"fit", fit_loop},
       {"nurbs", evaluate_nurbs}}};
  for (const auto& [known, target] : kTargets) {
    if (known == name) return target;
  }
  return nullptr;
}

void fail(std::string_view message) {
  std::fprintf(stderr, "fuzz: %.*s\n", static_cast<int>(message.size()), message.data());
  std::abort();
}

}  // namespace fuzz

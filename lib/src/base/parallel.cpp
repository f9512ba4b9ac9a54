#include "meshcontour/parallel.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace meshcontour {

void parallel_for(std::size_t count, std::size_t grain, unsigned threads,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  grain = std::max<std::size_t>(grain, 1);
  const std::size_t parts = (count + grain - 1) / grain;
  const auto run = [&](std::size_t part) { body(part * grain, std::min(count, (part + 1) * grain)); };
  if (threads == 1 || parts <= 1) {
    for (std::size_t part = 0; part < parts; ++part) run(part);
    return;
  }
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads));
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, parts, run); });
}

}  // namespace meshcontour

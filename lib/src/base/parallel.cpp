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
  // More threads than processors would gain nothing, and TBB complains on stderr.
  const int processors = tbb::this_task_arena::max_concurrency();
  tbb::task_arena arena(
      threads == 0 ? processors
                   : static_cast<int>(std::min<unsigned>(threads, static_cast<unsigned>(processors))));
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, parts, run); });
}

}  // namespace meshcontour

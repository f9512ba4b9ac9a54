#include "meshcontour/parallel.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#ifdef __SANITIZE_THREAD__
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#endif

namespace meshcontour {
namespace {

#ifdef __SANITIZE_THREAD__
// The thread sanitizer does not see how a library that was built without it hands work over.
void run_parts(std::size_t parts, unsigned threads, const std::function<void(std::size_t)>& run) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr error;
  std::mutex error_access;
  const auto work = [&] {
    try {
      for (std::size_t part = next++; part < parts; part = next++) run(part);
    } catch (...) {
      const std::lock_guard lock(error_access);
      error = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> workers;
    for (unsigned k = 0; k < (threads == 0 ? 4 : threads); ++k) workers.emplace_back(work);
  }
  if (error) std::rethrow_exception(error);
}
#else
void run_parts(std::size_t parts, unsigned threads, const std::function<void(std::size_t)>& run) {
  // More threads than processors would gain nothing, and TBB complains on stderr.
  const int processors = tbb::this_task_arena::max_concurrency();
  tbb::task_arena arena(
      threads == 0 ? processors
                   : static_cast<int>(std::min<unsigned>(threads, static_cast<unsigned>(processors))));
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, parts, run); });
}
#endif

}  // namespace

void parallel_for(std::size_t count, std::size_t grain, unsigned threads,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  grain = std::max<std::size_t>(grain, 1);
  const std::size_t parts = (count + grain - 1) / grain;
  const auto run = [&](std::size_t part) { body(part * grain, std::min(count, (part + 1) * grain)); };
  if (threads == 1 || parts <= 1) {
    for (std::size_t part = 0; part < parts; ++part) run(part);
    return;
  }
  run_parts(parts, threads, run);
}

}  // namespace meshcontour

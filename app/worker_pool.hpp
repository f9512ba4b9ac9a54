#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace meshcontour::app {

struct WorkerLimits {
  unsigned workers = 1;
  double seconds = 0;        ///< wall time a task; 0: none
  std::uint64_t memory = 0;  ///< resident bytes of a worker; 0: none
};

/// How a task ended.
struct TaskResult {
  enum class End {
    Done,
    Crashed,  ///< the worker died; `signal` says of what
    TimedOut,
    TooLarge,  ///< more memory than the limit
  };
  End end = End::Done;
  int signal = 0;
  std::string payload;  ///< what the task returned, when Done
};

/// Runs tasks 0..count-1 in worker processes, so that one that crashes, hangs or grows harms no other.
///
/// The workers are forked from the caller, which must not have started a thread or an OpenGL context. A
/// worker that died is replaced. Workers end with the caller.
///
/// @param task      runs in a worker.
/// @param finished  runs in the caller, in the order in which tasks end.
void run_in_workers(std::size_t count, const WorkerLimits& limits,
                    const std::function<std::string(std::size_t)>& task,
                    const std::function<void(std::size_t, const TaskResult&)>& finished);

}  // namespace meshcontour::app

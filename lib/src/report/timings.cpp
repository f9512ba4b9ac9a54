#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "meshcontour/report.hpp"

namespace meshcontour {
namespace {

double steady_ms() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(now).count();
}

double process_cpu_ms() {
  timespec time = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

}  // namespace

Timings::Running::Running(Timings& timings, std::string_view stage)
    : timings_(timings), entry_(timings.entry(stage)), wall_(steady_ms()), cpu_(process_cpu_ms()) {
  StageTime& time = timings_.stages_[entry_];
  if (time.start_ms == 0) time.start_ms = wall_;
}

Timings::Running::~Running() {
  StageTime& time = timings_.stages_[entry_];
  time.wall_ms += steady_ms() - wall_;
  time.cpu_ms += process_cpu_ms() - cpu_;
}

std::size_t Timings::entry(std::string_view stage) {
  const auto found = std::ranges::find(stages_, stage, &StageTime::stage);
  if (found != stages_.end()) return static_cast<std::size_t>(found - stages_.begin());
  stages_.push_back({std::string(stage)});
  return stages_.size() - 1;
}

void Timings::count(std::string_view stage, std::uint64_t items) {
  stages_[entry(stage)].items = items;
}

std::uint64_t peak_memory() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts kilobytes
}

}  // namespace meshcontour

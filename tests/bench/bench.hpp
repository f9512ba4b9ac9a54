#pragma once

// Times several ways to do the same thing, alternating, so that a change of the machine's mood hits all of
// them.

#include <algorithm>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

namespace bench {

/// CPU seconds of this process, all threads.
inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Contender {
  std::string name;
  std::function<void()> run;
  std::vector<double> seconds = {};

  double median() const {
    std::vector<double> sorted = seconds;
    std::ranges::sort(sorted);
    return sorted[sorted.size() / 2];
  }
};

/// Runs each contender `rounds` times, in turn.
inline void alternate(std::vector<Contender>& contenders, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    for (Contender& contender : contenders) {
      const double start = cpu_seconds();
      contender.run();
      contender.seconds.push_back(cpu_seconds() - start);
    }
  }
}

}  // namespace bench

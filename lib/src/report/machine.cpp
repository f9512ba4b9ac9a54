#include <fmt/format.h>
#include <sched.h>
#include <sys/utsname.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <fstream>

#include "meshcontour/report.hpp"

namespace meshcontour {
namespace {

unsigned usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return static_cast<unsigned>(std::max(1, CPU_COUNT(&set)));
}

// The value of the first line "key : value" of /proc/cpuinfo.
std::string cpu_property(std::string_view key) {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(':');
    if (!line.starts_with(key) || colon == line.npos) continue;
    const std::size_t begin = line.find_first_not_of(' ', colon + 1);
    return begin == line.npos ? std::string() : line.substr(begin);
  }
  return {};
}

bool clock_follows_load() {
  std::ifstream in("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  std::string governor;
  return in >> governor && governor != "performance";
}

}  // namespace

Machine this_machine() {
  Machine machine;
  utsname names = {};
  if (uname(&names) == 0) {
    machine.host = names.nodename;
    machine.system = fmt::format("{} {} {}", names.sysname, names.release, names.machine);
  }
  machine.cpu = cpu_property("model name");
  machine.cores = usable_cores();
  const std::string mhz = cpu_property("cpu MHz");
  std::from_chars(mhz.data(), mhz.data() + mhz.size(), machine.mhz);
  machine.cpu_scaling = clock_follows_load();
  if (getloadavg(machine.load.data(), 3) < 3) machine.load = {};
  return machine;
}

std::int64_t unix_time() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::seconds>(now).count();
}

}  // namespace meshcontour

#include "render/memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

#include "meshcontour/error.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

// Measured for Mesa 22 with LLVM 15: most of the addresses are never touched.
constexpr std::uint64_t kResident = 100'000'000, kAddresses = 600'000'000;

// The number after the key in a file of lines "key: number kB".
std::uint64_t kilobytes(const char* file, const std::string& key, std::uint64_t otherwise) {
  std::ifstream in(file);
  std::string word;
  std::uint64_t number = 0;
  while (in >> word) {
    if (word == key && in >> number) return 1024 * number;
  }
  return otherwise;
}

std::uint64_t first_number(const char* file, std::uint64_t otherwise) {
  std::ifstream in(file);
  std::uint64_t number = 0;
  return in >> number ? number : otherwise;  // "max" stands for no limit
}

std::uint64_t left_of(std::uint64_t limit, std::uint64_t used) {
  return limit > used ? limit - used : 0;
}

std::uint64_t available_addresses() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
  return left_of(limit.rlim_cur, kilobytes("/proc/self/status", "VmSize:", 0));
}

void require(std::uint64_t needed, std::uint64_t available, const Scene& scene) {
  if (needed <= available) return;
  throw Error(ErrorCode::OutOfMemory,
              fmt::format("a picture of {} x {} pixels needs about {} MB of memory, {} MB are left",
                          scene.width, scene.height, needed / 1'000'000, available / 1'000'000));
}

}  // namespace

std::uint64_t available_memory() {
  const std::uint64_t machine = kilobytes("/proc/meminfo", "MemAvailable:", kUnlimited);
  const std::uint64_t limit = first_number("/sys/fs/cgroup/memory.max", kUnlimited);
  const std::uint64_t group =
      limit == kUnlimited ? kUnlimited : left_of(limit, first_number("/sys/fs/cgroup/memory.current", 0));
  return std::min({machine, group, available_addresses()});
}

void require_memory(const Scene& scene, int largest_tile) {
  const auto width = static_cast<std::uint64_t>(scene.width),
             height = static_cast<std::uint64_t>(scene.height);
  const auto tile = static_cast<std::uint64_t>(largest_tile),
             across = static_cast<std::uint64_t>(scene.samples_across);
  constexpr std::uint64_t kPixel = 4, kSample = 8;  // bytes: colour; colour and depth
  const std::uint64_t picture =
      kPixel * width * height + kSample * std::min(across * width, tile) * std::min(across * height, tile);
  require(picture + kResident, available_memory(), scene);
  require(picture + kAddresses, available_addresses(), scene);
}

}  // namespace meshcontour::detail

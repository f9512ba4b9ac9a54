#include "meshcontour/parallel.hpp"

#include <stdexcept>
#include <vector>

#include "support/catch.hpp"

using namespace meshcontour;

TEST_CASE("parallel_for: every index is visited once, whatever the threads and the grain", "[base]") {
  const unsigned threads = GENERATE(0u, 1u, 2u, 5u);
  const std::size_t count = GENERATE(0u, 1u, 7u, 1000u);
  const std::size_t grain = GENERATE(0u, 1u, 64u, 5000u);
  std::vector<int> visits(count, 0);
  parallel_for(count, grain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ++visits[i];
  });
  CHECK(visits == std::vector<int>(count, 1));
}

TEST_CASE("parallel_for: an exception of a part reaches the caller", "[base][error]") {
  const auto fail = [](std::size_t begin, std::size_t) {
    if (begin == 50) throw std::runtime_error("part 50");
  };
  CHECK_THROWS_WITH(parallel_for(100, 1, 2, fail), "part 50");
}

#include <stdexcept>

#include "meshcontour/report.hpp"
#include "support/catch.hpp"

using namespace meshcontour;

TEST_CASE("Timings: stages in order of first use, repeats add up", "[report]") {
  Timings timings;
  CHECK(timings.measure("read", [] { return 7; }) == 7);
  timings.measure("fit", [] {});
  const double before = timings.stages()[0].wall_ms;
  volatile double sum = 0;
  timings.measure("read", [&] {
    for (int i = 0; i < 100'000; ++i) sum = sum + i;
  });
  timings.count("read", 12);
  REQUIRE(timings.stages().size() == 2);
  CHECK(timings.stages()[0].stage == "read");
  CHECK(timings.stages()[0].items == 12);
  CHECK(timings.stages()[0].wall_ms > before);
  CHECK(timings.stages()[0].cpu_ms > 0);
  CHECK(timings.stages()[1].stage == "fit");
  CHECK(timings.stages()[1].start_ms >= timings.stages()[0].start_ms);
}

TEST_CASE("Timings: a stage that fails is recorded, references pass through", "[report]") {
  Timings timings;
  CHECK_THROWS_AS(timings.measure("read", [] { throw std::runtime_error("x"); }), std::runtime_error);
  REQUIRE(timings.stages().size() == 1);
  CHECK(timings.stages()[0].wall_ms >= 0);
  int value = 0;
  CHECK(&timings.measure("fit", [&]() -> int& { return value; }) == &value);
}

TEST_CASE("peak_memory: grows with what is touched", "[report]") {
  const std::uint64_t before = peak_memory();
  const std::vector<char> block(256 << 20, 'x');
  CHECK(peak_memory() >= block.size());
  CHECK(peak_memory() > before);
}

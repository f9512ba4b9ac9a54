#include "worker_pool.hpp"

#include <unistd.h>

#include <csignal>
#include <map>
#include <vector>

#include "support/catch.hpp"

using namespace meshcontour::app;

namespace {

std::map<std::size_t, TaskResult> results_of(std::size_t count, const WorkerLimits& limits,
                                             const std::function<std::string(std::size_t)>& task) {
  std::map<std::size_t, TaskResult> results;
  run_in_workers(count, limits, task, [&](std::size_t number, const TaskResult& result) {
    CHECK(results.emplace(number, result).second);
  });
  return results;
}

}  // namespace

TEST_CASE("run_in_workers: every task gives its own answer, large ones too", "[app]") {
  const unsigned workers = GENERATE(1u, 2u, 5u);
  const auto results =
      results_of(20, {.workers = workers}, [](std::size_t i) { return std::string(i * 100000, 'x'); });
  REQUIRE(results.size() == 20);
  for (const auto& [number, result] : results) {
    CHECK(result.end == TaskResult::End::Done);
    CHECK(result.payload.size() == number * 100000);
  }
}

TEST_CASE("run_in_workers: a task that crashes, hangs or grows harms no other", "[app][error]") {
  const auto task = [](std::size_t i) -> std::string {
    std::signal(SIGTERM, SIG_DFL);  // the test framework's own handler would report it
    if (i == 1) raise(SIGKILL);
    while (i == 3) pause();
    std::vector<std::string> memory;
    while (i == 5) memory.emplace_back(std::size_t{1} << 22, 'x');
    return "ok";
  };
  const auto results = results_of(8, {.workers = 2, .seconds = 1, .memory = 400'000'000}, task);
  REQUIRE(results.size() == 8);
  CHECK(results.at(1).end == TaskResult::End::Crashed);
  CHECK(results.at(1).signal == SIGKILL);
  CHECK(results.at(3).end == TaskResult::End::TimedOut);
  CHECK((results.at(5).end == TaskResult::End::TooLarge || results.at(5).end == TaskResult::End::TimedOut));
  for (const std::size_t good : {0u, 2u, 4u, 6u, 7u}) CHECK(results.at(good).payload == "ok");
}

TEST_CASE("run_in_workers: no task, no worker", "[app]") {
  CHECK(results_of(0, {.workers = 4}, [](std::size_t) { return std::string(); }).empty());
}

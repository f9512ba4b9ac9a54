#include "batch.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <new>
#include <set>

#include "meshcontour/output.hpp"
#include "meshcontour/report.hpp"

namespace meshcontour::app {
namespace {

void print_diagnostics(const std::vector<Diagnostic>& diagnostics, int verbosity) {
  for (const Diagnostic& diagnostic : diagnostics) {
    const int needed = diagnostic.severity == Diagnostic::Severity::Warning ? 0 : 1;
    if (verbosity >= needed) fmt::print(stderr, "meshcontour: {}\n", diagnostic.text());
  }
}

void print_results(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw Error(ErrorCode::InputOutput, "standard output cannot be written");
  }
}

int run_job(const Job& job, const CommandLine& line) {
  const Run run = meshcontour::run(job);
  print_diagnostics(run.diagnostics, line.verbosity);
  if (job.outputs.empty() && line.report.empty()) {
    print_results(summary(run.model, run.boundaries, run.contours, run.timings.stages()));
  }
  return 0;
}

// Two inputs that write the same file would leave the last one's result only.
std::vector<Job> make_jobs(const CommandLine& line) {
  std::vector<Job> jobs;
  std::set<std::string> paths;
  for (std::size_t i = 0; i < line.inputs.size(); ++i) {
    jobs.push_back(make_job(line, line.inputs[i], i + 1));
    for (const OutputRequest& output : jobs.back().outputs) {
      if (paths.insert(output.path).second) continue;
      throw Error(ErrorCode::Usage, fmt::format("the output '{}' is named twice", printable(output.path)));
    }
  }
  return jobs;
}

}  // namespace

int run(const CommandLine& line) {
  prepare_process();
  const std::vector<Job> jobs = make_jobs(line);
  if (jobs.size() == 1) return run_job(jobs[0], line);
  std::size_t failed = 0;
  for (const Job& job : jobs) {
    try {
      run_job(job, line);
    } catch (const Error& error) {
      ++failed;
      fmt::print(stderr, "meshcontour: {}\n", error.what());
    }
  }
  if (failed > 0) fmt::print(stderr, "meshcontour: {} of {} inputs failed\n", failed, jobs.size());
  return failed > 0 ? 1 : 0;
}

}  // namespace meshcontour::app

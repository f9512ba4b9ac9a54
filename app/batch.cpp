#include "batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <map>
#include <set>
#include <thread>

#include "file_job.hpp"
#include "inputs.hpp"
#include "journal.hpp"
#include "meshcontour/output.hpp"
#include "model_limit.hpp"
#include "outcome.hpp"
#include "progress.hpp"
#include "worker_pool.hpp"

namespace meshcontour::app {
namespace {

void print_results(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw Error(ErrorCode::InputOutput, "standard output cannot be written");
  }
}

std::vector<FileJob> make_jobs(const CommandLine& line, const std::vector<std::string>& inputs) {
  std::vector<FileJob> jobs;
  std::set<std::string> paths;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    jobs.push_back(make_job(line, inputs[i], i + 1, inputs.size() > 1));
    for (const std::string& path : output_paths(jobs.back())) {
      if (paths.insert(path).second) continue;
      throw Error(ErrorCode::Usage, fmt::format("the output '{}' is named twice", printable(path)));
    }
  }
  return jobs;
}

// What a worker answered, or what became of it; an answer that cannot be read is no reason to lose the other
// files.
Outcome outcome_of(const FileJob& job, const TaskResult& result, const CommandLine& line) {
  const auto failed = [&](ErrorCode code, const std::string& what) {
    Outcome outcome;
    outcome.report.file = job.input;
    fail(code, fmt::format("{}: {}", printable(job.input), what), {job.input, 0, 0, ""}, line, outcome);
    return outcome;
  };
  switch (result.end) {
    case TaskResult::End::TimedOut:
      return failed(ErrorCode::TimeLimit, fmt::format("took longer than {} s", line.timeout));
    case TaskResult::End::TooLarge:
      return failed(ErrorCode::OutOfMemory,
                    fmt::format("needs more memory than {} MB", line.max_memory / 1'000'000));
    case TaskResult::End::Done:
      break;
    default:
      return failed(ErrorCode::Internal, fmt::format("the program was ended by signal {} ({})", result.signal,
                                                     strsignal(result.signal)));
  }
  try {
    return from_bytes(result.payload);
  } catch (const std::exception& error) {
    return failed(ErrorCode::Internal, fmt::format("internal error: {}", error.what()));
  }
}

// Takes outcomes as they come, prints them in the order of the inputs and keeps their reports.
class Collector {
 public:
  Collector(const std::vector<FileJob>& jobs, Journal& journal, const CommandLine& line)
      : jobs_(jobs), journal_(journal), progress_(jobs.size(), line.verbosity), reports_(jobs.size()) {}

  void take(std::size_t job, Outcome outcome) {
    if (outcome.report.outcome == FileReport::Outcome::Done) journal_.add(jobs_[job]);
    reports_[job] = std::move(outcome.report);
    limit_.apply(reports_, job);
    waiting_.emplace(job, std::move(outcome));
    progress_.step(jobs_[job].input);
    for (auto next = waiting_.begin(); next != waiting_.end() && next->first == printed_; ++printed_) {
      print(next->second);
      next = waiting_.erase(next);
    }
  }

  const std::vector<FileReport>& reports() const { return reports_; }

 private:
  void print(const Outcome& outcome) {
    if (outcome.output.empty() && outcome.errors.empty()) return;
    progress_.clear();
    if (!outcome.output.empty()) print_results(outcome.output);
    fmt::print(stderr, "{}", outcome.errors);
  }

  const std::vector<FileJob>& jobs_;
  Journal& journal_;
  Progress progress_;
  ModelLimit limit_;
  std::vector<FileReport> reports_;
  std::map<std::size_t, Outcome> waiting_;
  std::size_t printed_ = 0;
};

unsigned worker_count(const CommandLine& line, std::size_t tasks) {
  const unsigned wanted = line.threads > 0 ? line.threads : std::max(1u, std::thread::hardware_concurrency());
  return static_cast<unsigned>(std::min<std::size_t>(wanted, tasks));
}

void run_jobs(std::vector<FileJob> jobs, const CommandLine& line, Collector& collector,
              const Journal& journal) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (!journal.holds(jobs[i])) {
      open.push_back(i);
      continue;
    }
    Outcome outcome;
    outcome.report.file = jobs[i].input;
    outcome.report.outcome = FileReport::Outcome::Skipped;
    outcome.report.message = "up to date";
    collector.take(i, std::move(outcome));
  }
  if (jobs.size() == 1 && line.timeout == 0 && line.max_memory == 0) {
    for (const std::size_t i : open) collector.take(i, run_job(jobs[i], line));
    return;
  }
  const unsigned workers = worker_count(line, open.size());
  if (workers > 1) {
    for (FileJob& job : jobs) set_threads(job, 1);
  }
  run_in_workers(
      open.size(), {workers, line.timeout, line.max_memory},
      [&](std::size_t task) { return to_bytes(run_job(jobs[open[task]], line)); },
      [&](std::size_t task, const TaskResult& result) {
        const std::size_t job = open[task];
        collector.take(job, outcome_of(jobs[job], result, line));
      });
}

// Opened before the work, so that a report that cannot be written is found first.
class Reports {
 public:
  explicit Reports(const CommandLine& line) : line_(line) {
    for (const auto& [format, path] : line.reports) sinks_.push_back(&outputs_.open(path));
  }

  void write(const std::vector<FileReport>& reports) {
    for (std::size_t i = 0; i < sinks_.size(); ++i) {
      write_report(line_.reports[i].first, reports, this_machine(), start_, *sinks_[i]);
    }
    outputs_.commit();
  }

 private:
  const CommandLine& line_;
  std::int64_t start_ = unix_time();
  OutputSet outputs_;
  std::vector<Sink*> sinks_;
};

}  // namespace

int run(const CommandLine& line) {
  prepare_process();
  const std::vector<FileJob> jobs = make_jobs(line, take_shard(expand_inputs(line.inputs), line.shard));
  Reports reports(line);
  Journal journal(line.resume, line);
  Collector collector(jobs, journal, line);
  run_jobs(jobs, line, collector, journal);
  reports.write(collector.reports());

  const auto failures =
      std::ranges::count(collector.reports(), FileReport::Outcome::Failed, &FileReport::outcome);
  if (jobs.size() == 1) return collector.reports().front().exit_code;
  if (line.verbosity >= 0) {
    const auto skipped =
        std::ranges::count(collector.reports(), FileReport::Outcome::Skipped, &FileReport::outcome);
    fmt::print(stderr, "meshcontour: {} inputs: {} done, {} failed{}\n", jobs.size(),
               static_cast<std::ptrdiff_t>(jobs.size()) - failures - skipped, failures,
               skipped > 0 ? fmt::format(", {} were up to date", skipped) : "");
  }
  return failures > 0 ? 1 : 0;
}

}  // namespace meshcontour::app

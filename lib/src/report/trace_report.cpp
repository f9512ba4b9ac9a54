// Trace events as Perfetto, chrome://tracing and Speedscope read them; times in microseconds.

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "meshcontour/version.hpp"
#include "report/report_data.hpp"

namespace meshcontour::detail {
namespace {

class Trace {
 public:
  Trace(Sink& sink, double zero_ms) : sink_(sink), zero_ms_(zero_ms) {}

  void write(const Json& event) {
    sink_.write(first_ ? "\n  " : ",\n  ");
    sink_.write(dumped(event));
    first_ = false;
  }

  void add_name(const char* kind, unsigned row, const std::string& name) {
    write({{"name", kind}, {"ph", "M"}, {"pid", 1}, {"tid", row}, {"args", {{"name", name}}}});
  }

  void add_run(const std::vector<StageTime>& run, const FileReport& report, const std::string& file) {
    if (run.empty()) return;
    const unsigned row = report.worker + 1;
    const double end = run.back().start_ms + run.back().wall_ms;
    write({{"name", file},
           {"cat", "file"},
           {"ph", "X"},
           {"ts", at(run.front().start_ms)},
           {"dur", rounded(1000 * (end - run.front().start_ms))},
           {"pid", 1},
           {"tid", row}});
    for (const StageTime& time : run) {
      write({{"name", time.stage},
             {"cat", "stage"},
             {"ph", "X"},
             {"ts", at(time.start_ms)},
             {"dur", rounded(1000 * time.wall_ms)},
             {"pid", 1},
             {"tid", row},
             {"args", {{"file", file}, {"items", time.items}, {"cpu_ms", rounded(time.cpu_ms)}}}});
    }
    if (report.peak_memory == 0) return;
    const double megabytes = rounded(static_cast<double>(report.peak_memory) / (1 << 20));
    write({{"name", "rss_mb"}, {"ph", "C"}, {"ts", at(end)}, {"pid", 1}, {"args", {{"rss", megabytes}}}});
  }

 private:
  double at(double ms) const { return rounded(1000 * (ms - zero_ms_)); }

  Sink& sink_;
  double zero_ms_;
  bool first_ = true;
};

}  // namespace

void write_trace_report(std::span<const FileReport> files, const Machine&, std::int64_t, Sink& sink) {
  double zero = std::numeric_limits<double>::max();
  std::set<unsigned> workers;
  for (const FileReport& report : files) {
    workers.insert(report.worker);
    for (const auto& run : report.runs) {
      for (const StageTime& time : run) zero = std::min(zero, time.start_ms);
    }
  }
  sink.write(
      fmt::format("{{\"displayTimeUnit\": \"ms\",\n \"otherData\": {{\"version\": \"meshcontour {}\"}},\n "
                  "\"traceEvents\": [",
                  version()));
  Trace trace(sink, zero);
  trace.add_name("process_name", 0, "meshcontour");
  for (const unsigned worker : workers)
    trace.add_name("thread_name", worker + 1, fmt::format("worker {}", worker + 1));
  for (const FileReport& report : files) {
    for (const auto& run : report.runs) trace.add_run(run, report, stable_name(report.file));
  }
  sink.write("\n ]}\n");
}

}  // namespace meshcontour::detail

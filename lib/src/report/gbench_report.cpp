// The JSON of Google Benchmark, as its own reporter and compare.py agree on it.

#include "base/timestamp.hpp"
#include "meshcontour/version.hpp"
#include "report/report_data.hpp"

namespace meshcontour::detail {
namespace {

Json context(const Machine& machine, std::int64_t time) {
#ifdef NDEBUG
  constexpr const char* build = "release";
#else
  constexpr const char* build = "debug";
#endif
  return {{"date", iso_time(time) + "+00:00"},
          {"host_name", machine.host},
          {"executable", "meshcontour"},
          {"num_cpus", machine.cores},
          {"mhz_per_cpu", static_cast<int>(machine.mhz)},
          {"cpu_scaling_enabled", machine.cpu_scaling},
          {"caches", Json::array()},
          {"load_avg", machine.load},
          {"library_build_type", build},
          {"json_schema_version", 1},
          {"meshcontour_version", version()}};
}

class BenchmarkList {
 public:
  explicit BenchmarkList(Sink& sink) : sink_(sink) {}

  void add(const std::string& name, const std::vector<const StageTime*>& runs, const FileReport& report) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      Json entry = {{"name", name},
                    {"family_index", family_},
                    {"per_family_instance_index", 0},
                    {"run_name", name},
                    {"run_type", "iteration"},
                    {"repetitions", runs.size()},
                    {"repetition_index", i},
                    {"threads", 1},
                    {"iterations", 1},
                    {"real_time", rounded(runs[i]->wall_ms)},
                    {"cpu_time", rounded(runs[i]->cpu_ms)},
                    {"time_unit", "ms"},
                    {"items", runs[i]->items}};
      if (report.peak_memory > 0) entry["max_rss_bytes"] = report.peak_memory;
      sink_.write(first_ ? "\n    " : ",\n    ");
      sink_.write(dumped(entry));
      first_ = false;
    }
    ++family_;
  }

 private:
  Sink& sink_;
  std::size_t family_ = 0;
  bool first_ = true;
};

}  // namespace

void write_gbench_report(std::span<const FileReport> files, const Machine& machine, std::int64_t time,
                         Sink& sink) {
  sink.write("{\n  \"context\": " + dumped(context(machine, time)) + ",\n  \"benchmarks\": [");
  BenchmarkList list(sink);
  for (const FileReport& report : files) {
    if (report.outcome != FileReport::Outcome::Done) continue;
    const std::string file = stable_name(report.file);
    for (const StageSeries& series : stage_series(report))
      list.add(series.stage + "/" + file, series.runs, report);
    std::vector<StageTime> totals;
    for (const auto& run : report.runs)
      totals.push_back({"total", 0, total_wall_ms(run), total_cpu_ms(run), report.counts.triangles});
    std::vector<const StageTime*> runs;
    for (const StageTime& total : totals) runs.push_back(&total);
    list.add("total/" + file, runs, report);
  }
  sink.write("\n  ]\n}\n");
}

}  // namespace meshcontour::detail

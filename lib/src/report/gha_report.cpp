// github-action-benchmark's customSmallerIsBetter: a list of names and values.

#include <fmt/format.h>

#include "report/report_data.hpp"

namespace meshcontour::detail {

void write_gha_report(std::span<const FileReport> files, const Machine&, std::int64_t, Sink& sink) {
  bool first = true;
  const auto write = [&](const Json& entry) {
    sink.write(first ? "[\n  " : ",\n  ");
    sink.write(dumped(entry));
    first = false;
  };
  for (const FileReport& report : files) {
    if (report.outcome != FileReport::Outcome::Done) continue;
    const std::string file = stable_name(report.file);
    for (const StageSeries& series : stage_series(report)) {
      Json entry = {
          {"name", file + "/" + series.stage}, {"unit", "ms"}, {"value", rounded(series.median_wall_ms())}};
      if (series.runs.size() > 1) entry["range"] = fmt::format("\u00b1 {}", rounded(series.half_range_ms()));
      entry["extra"] = fmt::format("items: {}\nruns: {}", series.items(), series.runs.size());
      write(entry);
    }
    if (report.peak_memory == 0) continue;
    const double megabytes = rounded(static_cast<double>(report.peak_memory) / (1 << 20));
    write({{"name", file + "/peak_rss"}, {"unit", "MB"}, {"value", megabytes}});
  }
  sink.write(first ? "[]\n" : "\n]\n");
}

}  // namespace meshcontour::detail

#include <algorithm>
#include <array>

#include "report/report_data.hpp"

namespace meshcontour {
namespace {

using Writer = void (*)(std::span<const FileReport>, const Machine&, std::int64_t, Sink&);

// In the order of ReportFormat.
constexpr std::array<std::string_view, 6> kNames = {"json", "gbench", "junit", "gha", "trace", "html"};
constexpr std::array<Writer, 6> kWriters = {detail::write_json_report,  detail::write_gbench_report,
                                            detail::write_junit_report, detail::write_gha_report,
                                            detail::write_trace_report, detail::write_html_report};

}  // namespace

std::optional<ReportFormat> report_format(std::string_view name) {
  const auto found = std::ranges::find(kNames, name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<ReportFormat>(found - kNames.begin());
}

std::span<const std::string_view> report_format_names() {
  return kNames;
}

void write_report(ReportFormat format, std::span<const FileReport> files, const Machine& machine,
                  std::int64_t time, Sink& sink) {
  kWriters[static_cast<std::size_t>(format)](files, machine, time, sink);
}

}  // namespace meshcontour

// JUnit XML in the form of Jenkins' junit-10.xsd.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/escape.hpp"
#include "base/timestamp.hpp"
#include "meshcontour/version.hpp"
#include "report/report_data.hpp"

namespace meshcontour::detail {
namespace {

std::string_view error_type(int exit_code) {
  if (exit_code > 128) return "crash";
  switch (static_cast<ErrorCode>(exit_code)) {
    case ErrorCode::Usage:
      return "usage";
    case ErrorCode::BadData:
    case ErrorCode::NoInput:
      return "input";
    case ErrorCode::NoRenderer:
      return "renderer";
    case ErrorCode::OutOfMemory:
      return "memory";
    case ErrorCode::CannotCreate:
    case ErrorCode::InputOutput:
      return "output";
    case ErrorCode::TimeLimit:
      return "time";
    case ErrorCode::Internal:
      break;
  }
  return "internal";
}

double seconds(const FileReport& report) {
  double sum = 0;
  for (const auto& run : report.runs) sum += total_wall_ms(run);
  return sum / 1000;
}

std::string test_case(const FileReport& report) {
  const std::filesystem::path path(stable_name(report.file));
  const std::string folder = path.has_parent_path() ? path.parent_path().generic_string() : ".";
  std::string out = fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"",
                                xml_escaped(folder), xml_escaped(path.filename().string()), seconds(report));
  const std::string message = xml_escaped(report.message);
  switch (report.outcome) {
    case FileReport::Outcome::Done:
      return out + "/>\n";
    case FileReport::Outcome::Skipped:
      return out + fmt::format("><skipped message=\"{}\"/></testcase>\n", message);
    case FileReport::Outcome::Failed:
      break;
  }
  return out + fmt::format(">\n      <error message=\"{}\" type=\"{}\"/>\n    </testcase>\n", message,
                           error_type(report.exit_code));
}

}  // namespace

void write_junit_report(std::span<const FileReport> files, const Machine& machine, std::int64_t time,
                        Sink& sink) {
  const auto number = [&](FileReport::Outcome outcome) {
    return std::ranges::count(files, outcome, &FileReport::outcome);
  };
  double total = 0;
  for (const FileReport& report : files) total += seconds(report);
  const std::string sums = fmt::format("tests=\"{}\" failures=\"0\" errors=\"{}\"", files.size(),
                                       number(FileReport::Outcome::Failed));
  sink.write(fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"meshcontour\" {} time=\"{:.3f}\">\n",
      sums, total));
  sink.write(fmt::format(
      "  <testsuite name=\"batch\" {} skipped=\"{}\" time=\"{:.3f}\" timestamp=\"{}\" hostname=\"{}\">\n",
      sums, number(FileReport::Outcome::Skipped), total, iso_time(time), xml_escaped(machine.host)));
  sink.write(
      fmt::format("    <properties><property name=\"version\" value=\"{}\"/></properties>\n", version()));
  for (const FileReport& report : files) sink.write(test_case(report));
  sink.write("    <system-out></system-out>\n    <system-err></system-err>\n  </testsuite>\n</testsuites>\n");
}

}  // namespace meshcontour::detail

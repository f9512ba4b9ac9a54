#pragma once

// What the report formats have in common.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "meshcontour/report.hpp"

namespace meshcontour::detail {

using Json = nlohmann::ordered_json;

/// A stage over all repetitions of a file.
struct StageSeries {
  std::string stage;
  std::vector<const StageTime*> runs;

  double median_wall_ms() const;
  double median_cpu_ms() const;
  double half_range_ms() const;  ///< of the wall times
  std::uint64_t items() const { return runs.back()->items; }
};

/// In the order of their first run; stages that some runs lack are shorter.
std::vector<StageSeries> stage_series(const FileReport& report);

double total_wall_ms(const std::vector<StageTime>& run);
double total_cpu_ms(const std::vector<StageTime>& run);
double median(std::vector<double> values);  ///< 0 if there are none

/// The file without what differs from machine to machine: an absolute name loses its folders.
std::string stable_name(const std::string& file);

/// Three decimals: a microsecond is less than any clock here resolves reliably.
double rounded(double milliseconds);

/// One line; invalid UTF-8 becomes U+FFFD.
std::string dumped(const Json& json);

void write_json_report(std::span<const FileReport> files, const Machine& machine, std::int64_t time,
                       Sink& sink);
void write_gbench_report(std::span<const FileReport> files, const Machine& machine, std::int64_t time,
                         Sink& sink);
void write_junit_report(std::span<const FileReport> files, const Machine& machine, std::int64_t time,
                        Sink& sink);
void write_gha_report(std::span<const FileReport> files, const Machine& machine, std::int64_t time,
                      Sink& sink);
void write_html_report(std::span<const FileReport> files, const Machine& machine, std::int64_t time,
                       Sink& sink);
void write_trace_report(std::span<const FileReport> files, const Machine& machine, std::int64_t time,
                        Sink& sink);

}  // namespace meshcontour::detail

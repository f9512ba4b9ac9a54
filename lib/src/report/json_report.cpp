// Our own report: a record a line. data/report.schema.json describes it.

#include <array>

#include "base/timestamp.hpp"
#include "meshcontour/version.hpp"
#include "report/report_data.hpp"

namespace meshcontour {
namespace {

using detail::Json;

constexpr std::array<std::pair<const char*, std::uint64_t Counts::*>, 15> kCounts = {
    {{"shells", &Counts::shells},
     {"instances", &Counts::instances},
     {"patches", &Counts::patches},
     {"vertices", &Counts::vertices},
     {"triangles", &Counts::triangles},
     {"boundary_vertices", &Counts::boundary_vertices},
     {"boundary_edges", &Counts::boundary_edges},
     {"loops", &Counts::loops},
     {"open_chains", &Counts::open_chains},
     {"segments", &Counts::segments},
     {"lines", &Counts::lines},
     {"arcs", &Counts::arcs},
     {"circles", &Counts::circles},
     {"ellipses", &Counts::ellipses},
     {"splines", &Counts::splines}}};

constexpr std::array<const char*, 3> kOutcomes = {"done", "failed", "skipped"};

Json counts_json(const Counts& counts) {
  Json out = Json::object();
  for (const auto& [name, member] : kCounts) out[name] = counts.*member;
  return out;
}

Json outcome_json(const FileReport& report) {
  Json out = {{"outcome", kOutcomes[static_cast<std::size_t>(report.outcome)]},
              {"exit_code", report.exit_code}};
  if (!report.message.empty()) out["message"] = report.message;
  return out;
}

Json machine_json(const Machine& machine) {
  return {{"host", machine.host},   {"system", machine.system}, {"cpu", machine.cpu},
          {"cores", machine.cores}, {"mhz", machine.mhz},       {"cpu_scaling", machine.cpu_scaling},
          {"load", machine.load}};
}

Json stages_json(const FileReport& report) {
  Json stages = Json::array();
  for (const detail::StageSeries& series : detail::stage_series(report)) {
    Json wall = Json::array(), cpu = Json::array();
    for (const StageTime* time : series.runs) {
      wall.push_back(detail::rounded(time->wall_ms));
      cpu.push_back(detail::rounded(time->cpu_ms));
    }
    stages.push_back({{"stage", series.stage},
                      {"wall_ms", detail::rounded(series.median_wall_ms())},
                      {"cpu_ms", detail::rounded(series.median_cpu_ms())},
                      {"items", series.items()},
                      {"wall_ms_of_runs", wall},
                      {"cpu_ms_of_runs", cpu}});
  }
  return stages;
}

}  // namespace

void detail::write_json_report(std::span<const FileReport> files, const Machine& machine, std::int64_t time,
                               Sink& sink) {
  const Json place = machine_json(machine);
  for (const FileReport& report : files) {
    std::vector<double> wall, cpu;
    for (const auto& run : report.runs) {
      wall.push_back(total_wall_ms(run));
      cpu.push_back(total_cpu_ms(run));
    }
    Json record = {{"schema", 1}, {"file", stable_name(report.file)}};
    record.update(outcome_json(report));
    record["wall_ms"] = rounded(median(wall));
    record["cpu_ms"] = rounded(median(cpu));
    record["runs"] = report.runs.size();
    record["peak_memory_bytes"] = report.peak_memory;
    record["worker"] = report.worker;
    record["counts"] = counts_json(report.counts);
    record["stages"] = stages_json(report);
    record["version"] = version();
    record["date"] = iso_time(time) + "Z";
    record["machine"] = place;
    sink.write(dumped(record) + "\n");
  }
}

std::string to_record(const FileReport& report) {
  Json runs = Json::array();
  for (const auto& run : report.runs) {
    Json stages = Json::array();
    for (const StageTime& time : run) {
      stages.push_back({time.stage, time.start_ms, time.wall_ms, time.cpu_ms, time.items});
    }
    runs.push_back(std::move(stages));
  }
  Json record = {{"file", report.file}};
  record.update(outcome_json(report));
  record["counts"] = counts_json(report.counts);
  record["runs"] = std::move(runs);
  record["peak_memory"] = report.peak_memory;
  record["worker"] = report.worker;
  record["deviation"] = report.deviation;
  record["warnings"] = report.warnings;
  record["findings"] = report.findings;
  record["preview"] = {report.preview.picture, report.preview.model, report.preview.model_size};
  return detail::dumped(record);
}

FileReport from_record(std::string_view text) try {
  const Json record = Json::parse(text);
  FileReport report;
  report.file = record.at("file");
  const auto outcome = std::ranges::find(kOutcomes, record.at("outcome").get<std::string>());
  if (outcome == kOutcomes.end()) throw Error(ErrorCode::BadData, "a record with an unknown outcome");
  report.outcome = static_cast<FileReport::Outcome>(outcome - kOutcomes.begin());
  report.exit_code = record.at("exit_code");
  report.message = record.value("message", "");
  for (const auto& [name, member] : kCounts) report.counts.*member = record.at("counts").at(name);
  for (const Json& run : record.at("runs")) {
    auto& stages = report.runs.emplace_back();
    for (const Json& time : run)
      stages.push_back({time.at(0), time.at(1), time.at(2), time.at(3), time.at(4)});
  }
  report.peak_memory = record.at("peak_memory");
  report.worker = record.at("worker");
  report.deviation = record.at("deviation");
  report.warnings = record.at("warnings");
  report.findings = record.at("findings");
  const Json& preview = record.at("preview");
  report.preview = {preview.at(0), preview.at(1), preview.at(2)};
  return report;
} catch (const Json::exception& fault) {
  throw Error(ErrorCode::BadData, std::string("not a record of a file: ") + fault.what());
}

}  // namespace meshcontour

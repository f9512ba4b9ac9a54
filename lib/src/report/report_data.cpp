#include "report/report_data.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace meshcontour::detail {
namespace {

template <typename Member>
std::vector<double> values(const std::vector<const StageTime*>& runs, Member member) {
  std::vector<double> out;
  for (const StageTime* time : runs) out.push_back(time->*member);
  return out;
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

double StageSeries::median_wall_ms() const {
  return median(values(runs, &StageTime::wall_ms));
}

double StageSeries::median_cpu_ms() const {
  return median(values(runs, &StageTime::cpu_ms));
}

double StageSeries::half_range_ms() const {
  const auto [least, most] = std::ranges::minmax(values(runs, &StageTime::wall_ms));
  return (most - least) / 2;
}

std::vector<StageSeries> stage_series(const FileReport& report) {
  std::vector<StageSeries> series;
  for (const auto& run : report.runs) {
    for (const StageTime& time : run) {
      auto found = std::ranges::find(series, time.stage, &StageSeries::stage);
      if (found == series.end()) found = series.insert(found, StageSeries{time.stage, {}});
      found->runs.push_back(&time);
    }
  }
  return series;
}

double total_wall_ms(const std::vector<StageTime>& run) {
  double sum = 0;
  for (const StageTime& time : run) sum += time.wall_ms;
  return sum;
}

double total_cpu_ms(const std::vector<StageTime>& run) {
  double sum = 0;
  for (const StageTime& time : run) sum += time.cpu_ms;
  return sum;
}

std::string stable_name(const std::string& file) {
  const std::filesystem::path path(file);
  return (path.is_absolute() ? path.filename() : path.lexically_normal()).generic_string();
}

double rounded(double milliseconds) {
  return std::round(milliseconds * 1000) / 1000;
}

std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace meshcontour::detail

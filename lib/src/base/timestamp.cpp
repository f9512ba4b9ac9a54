#include "base/timestamp.hpp"

#include <fmt/format.h>

#include <chrono>

namespace meshcontour::detail {

std::string iso_time(std::int64_t seconds) {
  using namespace std::chrono;
  const sys_seconds time{std::chrono::seconds(seconds)};
  const auto day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss clock(time - day);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     clock.hours().count(), clock.minutes().count(), clock.seconds().count());
}

double julian_date(std::int64_t seconds) {
  return 2440587.5 + static_cast<double>(seconds) / 86400;
}

}  // namespace meshcontour::detail

#pragma once

#include <cstdint>
#include <string>

namespace meshcontour::detail {

/// Seconds since 1970 as 2000-01-31T23:59:59, UTC.
std::string iso_time(std::int64_t seconds);

/// Seconds since 1970 as a Julian date.
double julian_date(std::int64_t seconds);

}  // namespace meshcontour::detail

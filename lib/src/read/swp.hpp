#pragma once

#include <string>
#include <string_view>

#include "meshcontour/sweep.hpp"
#include "read/format.hpp"

namespace meshcontour::detail {

/// Reads a sweep file: curves (bez2 bez3 bsp2 bsp3 circ) and surfaces made of them (srev gcyl).
///
/// @throws Error  BadData with file, line, column, what was expected and found, and in brackets one of:
/// unknown-type,
///                duplicate-name, unknown-curve, profile-not-2d, bad-count, out-of-range, bad-integer,
///                bad-number, expected-bracket, unexpected-end.
SweepScene parse_swp(std::string_view bytes, const std::string& name);

/// Possible if one of the type names is a word of the text; sure if it is the first.
Match sniff_swp(std::string_view head, std::uint64_t size);

Model read_swp(std::string_view bytes, const ReadContext& context);

}  // namespace meshcontour::detail

// The fast number scan gives the bits of std::from_chars, or leaves the number to another way.

#include <bit>
#include <charconv>
#include <cmath>
#include <string>

#include "fuzz/targets.hpp"
#include "read/fast_number.hpp"

namespace fuzz {

void scan_numbers(Bytes input) {
  using namespace meshcontour::detail;
  std::string text(input.begin(), input.end());
  const std::size_t size = text.size();
  text += '<';
  text.append(16, '\0');
  const char* const begin = text.data();
  const char* place = begin;
  double value = 0, expected = 0;
  const bool scanned = scan_number(place, begin + size, value);
  const auto [end, error] = std::from_chars(begin, begin + size, expected);
  const bool readable = error == std::errc() && std::isfinite(expected);
  require(scanned == readable, "scanned, or not, against from_chars");
  if (!scanned) return;
  require(place == end, "another end than from_chars'");
  require(std::bit_cast<std::uint64_t>(value) == std::bit_cast<std::uint64_t>(expected), "another value");
}

}  // namespace fuzz

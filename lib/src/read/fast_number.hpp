#pragma once

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// Eight bytes as an integer whose lowest byte is the first.
inline std::uint64_t load_eight(const char* p) {
  std::uint64_t word = 0;
  std::memcpy(&word, p, sizeof word);
  if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap64(word);
  return word;
}

/// Decimal digits at the start of eight bytes, and their value.
struct DigitRun {
  unsigned count = 0;  ///< 0 to 8
  std::uint64_t value = 0;
};

/// Eight digits at a time within one register [Lemire 2021, section 9.1 gives the multiplications].
inline DigitRun leading_digits(std::uint64_t word) {
  word ^= 0x3030303030303030u;  // digits become 0 to 9
  const std::uint64_t others = ((word + 0x7676767676767676u) | word) & 0x8080808080808080u;
  const unsigned count = others == 0 ? 8u : static_cast<unsigned>(std::countr_zero(others)) / 8u;
  if (count == 0) return {};
  word <<= 64u - 8u * count;
  word = word * 10 + (word >> 8);
  word = ((word & 0x000000FF000000FFu) * 0x000F424000000064u +
          ((word >> 16) & 0x000000FF000000FFu) * 0x0000271000000001u) >>
         32;
  return {count, word & 0xFFFFFFFFu};
}

inline constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                          1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                          1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
inline constexpr std::uint64_t kWholePowersOfTen[] = {1,      10,      100,      1000,     10000,
                                                      100000, 1000000, 10000000, 100000000};

/// The number at p by from_chars; false if there is none, or none that is finite.
inline bool scan_any_number(const char*& p, const char* end, double& value) {
  const auto [last, error] = std::from_chars(p, end, value);
  if (error != std::errc() || !std::isfinite(value)) return false;
  p = last;
  return true;
}

/// Reads the number at p and moves p behind it; the same value as from_chars gives. With at most 2^53 as
/// digits and a power of ten up to 22 both are exact, so that one division rounds correctly [Clinger 1990];
/// any other number goes to from_chars.
///
/// @param end  at least 8 bytes after it must be readable, and a byte that belongs to no number must stand at
/// it.
inline bool scan_number(const char*& p, const char* end, double& value) {
  const char* s = p;
  const bool negative = *s == '-';
  s += negative;
  const char* const digits = s;
  std::uint64_t mantissa = 0;
  for (unsigned digit = 0; (digit = static_cast<unsigned char>(*s) - '0') <= 9; ++s)
    mantissa = mantissa * 10 + digit;
  const std::ptrdiff_t whole_digits = s - digits;
  if (whole_digits == 0) return scan_any_number(p, end, value);
  int fraction_digits = 0;
  if (*s == '.') {
    ++s;
    DigitRun run{8, 0};
    for (int k = 0; k < 2 && run.count == 8; ++k) {
      run = leading_digits(load_eight(s));
      mantissa = mantissa * kWholePowersOfTen[run.count] + run.value;
      s += run.count;
      fraction_digits += static_cast<int>(run.count);
    }
    if (run.count == 8) return scan_any_number(p, end, value);
  }
  int exponent = -fraction_digits;
  if ((*s | 0x20) == 'e') {
    ++s;
    const bool below = *s == '-';
    s += below || *s == '+';
    const DigitRun run = leading_digits(load_eight(s));
    if (run.count == 0 || run.count == 8) return scan_any_number(p, end, value);
    s += run.count;
    exponent += (below ? -1 : 1) * static_cast<int>(run.value);
  }
  constexpr std::uint64_t kExact = std::uint64_t{1} << 53;
  const bool exact =
      whole_digits + fraction_digits <= 19 && mantissa <= kExact && exponent >= -22 && exponent <= 22;
  if (!exact) return scan_any_number(p, end, value);
  const auto whole = static_cast<double>(mantissa);
  const double size = exponent < 0 ? whole / kPowersOfTen[-exponent] : whole * kPowersOfTen[exponent];
  value = negative ? -size : size;
  p = s;
  return true;
}

/// Reads the digits of an index at p, at most 9, and moves p behind them.
inline bool scan_index(const char*& p, Index& value) {
  Index number = 0;
  const char* s = p;
  for (unsigned digit = 0; (digit = static_cast<unsigned char>(*s) - '0') <= 9; ++s)
    number = number * 10 + digit;
  const std::ptrdiff_t length = s - p;
  if (length < 1 || length > 9) return false;
  value = number;
  p = s;
  return true;
}

}  // namespace meshcontour::detail

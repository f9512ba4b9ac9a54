#include "read/fast_number.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <random>
#include <string>

#include "support/catch.hpp"

using namespace meshcontour;
using namespace meshcontour::detail;

namespace {

// What scan_number takes of a text that a quote follows, and the rest that it leaves.
struct Scanned {
  bool taken = false;
  double value = 0;
  std::string rest;
};

Scanned scan(const std::string& text) {
  const std::string padded = text + "\"/>      ";
  const char* p = padded.data();
  const char* const end = p + text.size();
  Scanned result;
  result.taken = scan_number(p, end, result.value);
  result.rest.assign(p, end > p ? end : p);
  return result;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool agrees(const std::string& text) {
  double expected = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), expected);
  const Scanned found = scan(text);
  if (error != std::errc() || !std::isfinite(expected)) return !found.taken;
  return found.taken && same_bits(found.value, expected) &&
         found.rest == std::string(end, text.data() + text.size());
}

}  // namespace

TEST_CASE("scan_number: gives the bits that from_chars gives for every way of printing", "[read][property]") {
  std::mt19937_64 random(7);
  std::size_t different = 0;
  for (int trial = 0; trial < 30'000; ++trial) {
    const double scale = std::pow(10.0, static_cast<double>(random() % 60) - 30);
    const double value = (static_cast<double>(random() % 2'000'001) / 1e6 - 1) * scale;
    const auto bits = std::bit_cast<double>(random());
    for (const double v : {value, std::round(value * 1e3) / 1e3, std::isfinite(bits) ? bits : 0.0}) {
      for (const char* format : {"{:.15g}", "{:.6g}", "{}", "{:f}", "{:.17e}"}) {
        const std::string text = fmt::format(fmt::runtime(format), v);
        if (!agrees(text)) ++different;
      }
    }
  }
  CHECK(different == 0);
}

TEST_CASE("scan_number: agrees with from_chars on odd forms", "[read]") {
  const std::string text = GENERATE(
      "0", "-0", "1.", ".5", "-.5", "-", ".", "", "e5", "1e", "1e+", "1e5", "1E-5", "1e+05",
      "4.93054498004026e-014", "1e22", "1e23", "1e-22", "1e-23", "9007199254740992", "9007199254740993",
      "123456789012345678901234567890", "0.1234567812345678", "0.12345678123456789", "1234567890.123456789",
      "0.00000000000000000001", "nan", "inf", "-inf", "1e400", "1e-400", "1e99999999999", "0x10", "1,5",
      "1 2", "1d0", "12abc", "1e00000005", "0000000000000000000001",
      "179769313486231570814527423731704356798070e267", "4.9e-324", "2.2250738585072011e-308");
  INFO(text);
  CHECK(agrees(text));
}

TEST_CASE("scan_index: digits only, at most nine", "[read]") {
  const auto index = [](const std::string& text) -> long {
    const std::string padded = text + "\"";
    const char* p = padded.data();
    Index value = 0;
    return scan_index(p, value) && *p == '"' ? static_cast<long>(value) : -1;
  };
  CHECK(index("0") == 0);
  CHECK(index("007") == 7);
  CHECK(index("999999999") == 999'999'999);
  for (const char* bad : {"", "-1", "+1", "1.0", "1e0", "4294967298", "0000000001", "x"})
    CHECK(index(bad) == -1);
}

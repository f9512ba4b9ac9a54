#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "meshcontour/error.hpp"

namespace meshcontour::detail {

/// Numbers as bytes: little endian, small integers short.
class ByteWriter {
 public:
  void byte(std::uint8_t value) { bytes_ += static_cast<char>(value); }

  void fixed(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) byte(static_cast<std::uint8_t>(value >> (8 * i)));
  }

  /// Seven bits a byte, the low ones first.
  void count(std::uint64_t value) {
    for (; value > 127; value >>= 7) byte(static_cast<std::uint8_t>(value | 128));
    byte(static_cast<std::uint8_t>(value));
  }

  /// Near zero short, of either sign.
  void integer(std::int64_t value) {
    count(static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63));
  }

  void number(double value) { fixed(std::bit_cast<std::uint64_t>(value), 8); }

  void text(std::string_view value) {
    count(value.size());
    bytes_ += value;
  }

  const std::string& bytes() const { return bytes_; }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads what a ByteWriter wrote. All throw Error{BadData} where the bytes end or a value is out of range.
class ByteReader {
 public:
  ByteReader(std::string_view bytes, std::string_view name) : rest_(bytes), name_(name) {}

  std::size_t remaining() const { return rest_.size(); }
  std::string_view rest() const { return rest_; }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::BadData, "wavelet stream: " + what, {std::string(name_), 0, 0, {}});
  }

  std::string_view take(std::uint64_t count) {
    if (count > rest_.size()) fail("it ends too early");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  std::uint64_t fixed(std::size_t count) {
    std::uint64_t value = 0;
    int shift = 0;
    for (const char c : take(count)) {
      value |= std::uint64_t{static_cast<std::uint8_t>(c)} << shift;
      shift += 8;
    }
    return value;
  }

  std::uint64_t count(std::uint64_t largest) {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 63; shift += 7) {
      const std::uint64_t byte = fixed(1);
      value |= (byte & 127) << shift;
      if (byte > 127) continue;
      if (value > largest) fail("a number is out of range");
      return value;
    }
    fail("a number is too long");
  }

  std::int64_t integer() {
    const std::uint64_t value = count(std::uint64_t{1} << 62);
    return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
  }

  double number() {
    const double value = std::bit_cast<double>(fixed(8));
    if (!(value - value == 0)) fail("a number is not finite");
    return value;
  }

  std::string text() { return std::string(take(count(rest_.size()))); }

 private:
  std::string_view rest_, name_;
};

}  // namespace meshcontour::detail

#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "read/ply_header.hpp"

namespace meshcontour::detail {

/// The values of a text PLY, one after the other.
class PlyTextValues {
 public:
  explicit PlyTextValues(TextCursor& in) : in_(in) {}

  double number(PlyType) { return in_.number(); }
  std::int64_t integer(PlyType) {
    return in_.integer(std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::uint32_t>::max());
  }
  /// The length of a list whose items follow.
  std::size_t list_length(PlyType, PlyType) {
    return static_cast<std::size_t>(in_.integer(0, static_cast<std::int64_t>(in_.remaining() / 2 + 1)));
  }
  void skip(PlyType, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) in_.word();
  }
  void begin_elements(const std::string&) {}
  void end_element() { in_.expect_line_end(); }
  bool at_end() { return in_.at_end(); }
  Spot spot() const { return in_.spot(); }
  [[noreturn]] void fail(const std::string& message) const { in_.fail(message); }

 private:
  TextCursor& in_;
};

/// The values of a binary PLY.
class PlyBinaryValues {
 public:
  PlyBinaryValues(std::string_view bytes, std::string file, bool big_endian)
      : bytes_(bytes), file_(std::move(file)), big_endian_(big_endian) {}

  double number(PlyType type) {
    const double value = take(type);
    if (!std::isfinite(value)) fail("a number is not finite");
    return value;
  }
  std::int64_t integer(PlyType type) { return static_cast<std::int64_t>(take(type)); }
  std::size_t list_length(PlyType type, PlyType item) {
    const std::int64_t length = integer(type);
    if (length < 0 || static_cast<std::size_t>(length) > (bytes_.size() - offset_) / size_of(item)) {
      fail(fmt::format("a list of {} items, but only {} bytes follow", length, bytes_.size() - offset_));
    }
    return static_cast<std::size_t>(length);
  }
  void skip(PlyType type, std::size_t count) { take_bytes(count * size_of(type)); }
  void end_element() { ++element_; }
  Spot spot() const { return {file_, 0, 0, element_name_ + fmt::format(" {}", element_ + 1)}; }
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorCode::BadData, message, spot());
  }

  void begin_elements(const std::string& name) {
    element_name_ = name;
    element_ = 0;
  }
  bool at_end() const { return offset_ == bytes_.size(); }

 private:
  const char* take_bytes(std::size_t size) {
    if (size > bytes_.size() - offset_) fail("the file ends here");
    const char* const at = bytes_.data() + offset_;
    offset_ += size;
    return at;
  }

  template <typename T>
  double take_as() {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), take_bytes(sizeof(T)), sizeof(T));
    if (big_endian_) std::ranges::reverse(raw);
    T value{};
    std::memcpy(&value, raw.data(), sizeof(T));
    return static_cast<double>(value);
  }

  // Every type fits a double exactly.
  double take(PlyType type) {
    switch (type) {
      case PlyType::Int8:
        return take_as<std::int8_t>();
      case PlyType::UInt8:
        return take_as<std::uint8_t>();
      case PlyType::Int16:
        return take_as<std::int16_t>();
      case PlyType::UInt16:
        return take_as<std::uint16_t>();
      case PlyType::Int32:
        return take_as<std::int32_t>();
      case PlyType::UInt32:
        return take_as<std::uint32_t>();
      case PlyType::Float32:
        return take_as<float>();
      case PlyType::Float64:
        break;
    }
    return take_as<double>();
  }

  std::string_view bytes_;
  std::string file_;
  bool big_endian_;
  std::size_t offset_ = 0;
  std::string element_name_;
  std::uint64_t element_ = 0;
};

}  // namespace meshcontour::detail

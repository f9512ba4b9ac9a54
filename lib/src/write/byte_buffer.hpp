#pragma once

#include <bit>
#include <string>

#include "meshcontour/output.hpp"

namespace meshcontour::detail {

static_assert(std::endian::native == std::endian::little, "values are written as they stand in memory");

/// Collects little-endian values for a sink. Call flush() at the end.
class ByteBuffer {
 public:
  explicit ByteBuffer(Sink& sink) : sink_(sink) { bytes_.reserve(kPiece + 64); }

  template <typename T>
  void put(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  void put_text(std::string_view text) { bytes_.append(text); }

  /// Call it between records of less than 64 bytes.
  void flush_if_full() {
    if (bytes_.size() >= kPiece) flush();
  }

  void flush() {
    sink_.write(bytes_);
    bytes_.clear();
  }

 private:
  static constexpr std::size_t kPiece = std::size_t{1} << 16;

  Sink& sink_;
  std::string bytes_;
};

}  // namespace meshcontour::detail

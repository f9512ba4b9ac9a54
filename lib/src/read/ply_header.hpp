#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text_cursor.hpp"

namespace meshcontour::detail {

enum class PlyType : std::uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

std::size_t size_of(PlyType type);
bool is_integer(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float32;
  std::optional<PlyType> count_type;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< as declared; checked against the bytes that follow
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { Text, LittleEndian, BigEndian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Text;
  std::vector<PlyElement> elements;
};

/// Reads up to and with the line "end_header".
///
/// @throws Error  BadData with the line if the header is wrong or declares more elements than the bytes that
/// follow
///                could hold.
PlyHeader read_ply_header(TextCursor& in);

}  // namespace meshcontour::detail

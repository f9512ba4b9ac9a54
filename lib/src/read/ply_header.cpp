#include "read/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace meshcontour::detail {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes = {{{"char", PlyType::Int8},
                                                                          {"int8", PlyType::Int8},
                                                                          {"uchar", PlyType::UInt8},
                                                                          {"uint8", PlyType::UInt8},
                                                                          {"short", PlyType::Int16},
                                                                          {"int16", PlyType::Int16},
                                                                          {"ushort", PlyType::UInt16},
                                                                          {"uint16", PlyType::UInt16},
                                                                          {"int", PlyType::Int32},
                                                                          {"int32", PlyType::Int32},
                                                                          {"uint", PlyType::UInt32},
                                                                          {"uint32", PlyType::UInt32},
                                                                          {"float", PlyType::Float32},
                                                                          {"float32", PlyType::Float32},
                                                                          {"double", PlyType::Float64},
                                                                          {"float64", PlyType::Float64}}};

PlyType read_type(TextCursor& in) {
  const std::string_view word = in.word();
  const auto known = std::ranges::find(kTypes, word, &std::pair<std::string_view, PlyType>::first);
  if (known == kTypes.end()) in.fail(fmt::format("unknown type '{}'", printable(word, 40)));
  return known->second;
}

PlyEncoding read_encoding(TextCursor& in) {
  const std::string_view word = in.word();
  if (word == "ascii") return PlyEncoding::Text;
  if (word == "binary_little_endian") return PlyEncoding::LittleEndian;
  if (word == "binary_big_endian") return PlyEncoding::BigEndian;
  in.fail(fmt::format("unknown encoding '{}'", printable(word, 40)));
}

PlyProperty read_property(TextCursor& in) {
  PlyProperty property;
  if (in.peek() == "list") {
    in.word();
    property.count_type = read_type(in);
    if (!is_integer(*property.count_type)) in.fail("the length of a list is a whole number");
  }
  property.type = read_type(in);
  property.name = in.word();
  return property;
}

// The fewest bytes that one of the element takes.
std::size_t least_bytes(const PlyElement& element, PlyEncoding encoding) {
  std::size_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    bytes += encoding == PlyEncoding::Text ? 2 : size_of(property.count_type.value_or(property.type));
  }
  return bytes;
}

void check_counts(const PlyHeader& header, const TextCursor& in) {
  std::uint64_t left = in.remaining() + 1;  // the last number of a text needs nothing behind it
  for (const PlyElement& element : header.elements) {
    const std::size_t bytes = least_bytes(element, header.encoding);
    if (bytes == 0) continue;
    if (element.count > left / bytes) {
      in.fail(fmt::format("{} elements '{}' declared, but only {} bytes follow", element.count,
                          printable(element.name, 40), in.remaining()));
    }
    left -= element.count * bytes;
  }
}

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool is_integer(PlyType type) {
  return type < PlyType::Float32;
}

PlyHeader read_ply_header(TextCursor& in) {
  PlyHeader header;
  in.expect("ply");
  in.expect_line_end();
  in.expect("format");
  header.encoding = read_encoding(in);
  in.rest_of_line();  // the version
  while (true) {
    const std::string_view keyword = in.word();
    if (keyword == "end_header") break;
    if (keyword == "element") {
      PlyElement element;
      element.name = in.word();
      element.count = static_cast<std::uint64_t>(in.integer(0, std::numeric_limits<std::int64_t>::max()));
      header.elements.push_back(std::move(element));
      in.expect_line_end();
    } else if (keyword == "property") {
      if (header.elements.empty()) in.fail("a property before any element");
      header.elements.back().properties.push_back(read_property(in));
      in.expect_line_end();
    } else if (keyword == "comment" || keyword == "obj_info") {
      in.rest_of_line();
    } else {
      in.fail(
          fmt::format("expected 'element', 'property' or 'end_header', found '{}'", printable(keyword, 40)));
    }
  }
  in.rest_of_line();
  check_counts(header, in);
  return header;
}

}  // namespace meshcontour::detail

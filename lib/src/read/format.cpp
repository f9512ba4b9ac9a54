#include "read/format.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "read/net.hpp"
#include "read/obj.hpp"
#include "read/off.hpp"
#include "read/ply.hpp"
#include "read/stl.hpp"
#include "read/swp.hpp"
#include "read/wavelet.hpp"
#include "read/webxml.hpp"

namespace meshcontour::detail {
namespace {

std::string extension_of(std::string_view name) {
  std::string extension = std::filesystem::path(name).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

// Of the formats that match at least so well, the first whose extension agrees; else the first of all, if a
// signature says so or no other is possible.
const Format* best_match(std::span<const Match> matches, std::span<const Format> table,
                         std::string_view extension, Match least) {
  const Format* first = nullptr;
  std::size_t count = 0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (matches[i] < least) continue;
    if (std::ranges::find(table[i].extensions, extension) != table[i].extensions.end()) return &table[i];
    if (first == nullptr) first = &table[i];
    ++count;
  }
  return least == Match::Sure || (least == Match::Possible && count == 1) ? first : nullptr;
}

}  // namespace

const Format& detect_format(std::string_view head, std::uint64_t size, std::string_view name,
                            std::span<const Format> table) {
  const Spot spot{std::string(name), 0, 0, ""};
  if (head.empty()) throw Error(ErrorCode::BadData, "empty file", spot);
  const std::string extension = extension_of(name);
  std::vector<Match> matches;
  for (const Format& format : table) matches.push_back(format.sniff(head, size));
  for (const Match least : {Match::Sure, Match::IfNamed, Match::Possible}) {
    if (const Format* format = best_match(matches, table, extension, least)) return *format;
  }
  std::vector<std::string_view> names;
  for (const Format& format : table) {
    const bool named = std::ranges::find(format.extensions, extension) != format.extensions.end();
    if (named) {
      throw Error(ErrorCode::BadData, fmt::format("not {}: the content is something else", format.name),
                  spot);
    }
    names.push_back(format.name);
  }
  throw Error(ErrorCode::BadData, fmt::format("not a known format ({})", fmt::join(names, ", ")), spot);
}

std::span<const Format> formats() {
  static const std::vector<Format> table = {
      {"webxml", {"xml", "webxml"}, sniff_webxml, read_webxml, read_webxml_file},
      {"swept surfaces", {"swp"}, sniff_swp, read_swp},
      {"STL", {"stl"}, sniff_stl, read_stl, read_stl_file},
      {"PLY", {"ply"}, sniff_ply, read_ply},
      {"OFF", {"off"}, sniff_off, read_off},
      {"OBJ", {"obj"}, sniff_obj, read_obj},
      {"wavelet stream", {"mcw"}, sniff_wavelet, read_wavelet},
      {"control mesh", {"net"}, sniff_net, read_net},
  };
  return table;
}

}  // namespace meshcontour::detail

#include "read/stl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "base/text_cursor.hpp"
#include "model/point_numbering.hpp"
#include "read/polygon_mesh.hpp"

namespace meshcontour::detail {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is copied as it is");

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kFacetBytes = 50;
constexpr std::size_t kNormalBytes = 12;
constexpr std::size_t kFacetsAtATime = 85;
constexpr std::size_t kFacetsInPart = 4096;  // read at a time; they stay in the cache

std::uint64_t declared_facets(std::string_view head) {
  std::uint32_t count = 0;
  std::memcpy(&count, head.data() + kHeaderBytes - sizeof count, sizeof count);
  return count;
}

bool same_word(std::string_view word, std::string_view lower) {
  return std::ranges::equal(word, lower, [](char c, char expected) {
    return (c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) == expected;
  });
}

bool starts_as_text(std::string_view head) {
  const std::size_t start = head.find_first_not_of(" \t\r\n");
  return start != std::string_view::npos && same_word(head.substr(start, 5), "solid");
}

bool is_binary(std::string_view head, std::uint64_t size) {
  return size >= kHeaderBytes && head.size() >= kHeaderBytes &&
         kHeaderBytes + kFacetBytes * declared_facets(head) == size;
}

using Corner = std::array<float, 3>;

// Remembers the numbers of corners met lately: most facets share corners with those just before them, so that
// few corners are looked up in the table of all points.
class RecentCorners {
 public:
  RecentCorners() : entries_(kEntries) {}

  /// The number of a corner; kUnknown if it was not met lately.
  Index find(const Corner& corner) const {
    const Entry& entry = entries_[place(corner)];
    return entry.corner == corner ? entry.number : kUnknown;
  }

  void keep(const Corner& corner, Index number) { entries_[place(corner)] = {corner, number}; }

  static constexpr Index kUnknown = 0xFFFFFFFF;

 private:
  struct Entry {
    Corner corner{};
    Index number = kUnknown;
  };
  static constexpr int kBits = 15;
  static constexpr std::size_t kEntries = std::size_t{1} << kBits;

  // 0 and -0, which are equal, may stand in two places.
  static std::size_t place(const Corner& corner) {
    const auto bits = [](float value) { return std::uint64_t{std::bit_cast<std::uint32_t>(value)}; };
    const std::uint64_t mixed =
        (bits(corner[0]) << 32 | bits(corner[1])) * 0x9E3779B97F4A7C15 ^ bits(corner[2]) * 0xE7037ED1A0B428DB;
    return static_cast<std::size_t>((mixed ^ mixed >> 29) * 0x8EBC6AF09C88C6E3 >> (64 - kBits));
  }

  std::vector<Entry> entries_;
};

// Facets in the order of the file, a few at a time.
class BinaryFacets {
 public:
  BinaryFacets(std::size_t count, const ReadContext& context)
      : context_(context), mesh_(context), numbering_(count / 2 + count / 64) {
    mesh_.reserve_triangles(count);
  }

  /// @param facets  whole ones.
  void add(std::string_view facets) {
    for (; !facets.empty(); facets.remove_prefix(std::min(facets.size(), kFacetsAtATime * kFacetBytes))) {
      add_batch(facets.substr(0, kFacetsAtATime * kFacetBytes));
    }
  }

  Model finish() && {
    mesh_.points = std::move(numbering_).take_points();
    numbering_ = PointNumbering();
    return std::move(mesh_).finish();
  }

 private:
  void add_batch(std::string_view facets) {
    const std::size_t size = facets.size() / kFacetBytes;
    unknown_.clear();
    for (std::size_t i = 0; i < size; ++i) {
      std::memcpy(corners_.data() + 3 * i, facets.data() + i * kFacetBytes + kNormalBytes,
                  3 * sizeof(Corner));
      for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) find(k);
    }
    number_unknown();
    for (std::size_t i = 0; i < size; ++i) {
      mesh_.add_triangle({numbers_[3 * i], numbers_[3 * i + 1], numbers_[3 * i + 2]});
    }
    facets_ += size;
  }

  void find(std::size_t k) {
    const Corner& corner = corners_[k];
    numbers_[k] = recent_.find(corner);
    if (numbers_[k] != RecentCorners::kUnknown) return;
    // Zero times anything finite is zero.
    if (!(corner[0] * 0 + corner[1] * 0 + corner[2] * 0 == 0)) {
      throw Error(ErrorCode::BadData, "a coordinate is not finite",
                  {context_.name, 0, 0, fmt::format("facet {}", facets_ + k / 3 + 1)});
    }
    unknown_.push_back(Point(corner[0], corner[1], corner[2]));
    unknown_corners_[unknown_.size() - 1] = static_cast<std::uint32_t>(k);
  }

  void number_unknown() {
    std::array<Index, 3 * kFacetsAtATime> found;
    numbering_.add(unknown_, std::span(found).first(unknown_.size()));
    for (std::size_t i = 0; i < unknown_.size(); ++i) {
      const std::uint32_t k = unknown_corners_[i];
      numbers_[k] = found[i];
      recent_.keep(corners_[k], found[i]);
    }
  }

  const ReadContext& context_;
  PolygonMesh mesh_;
  PointNumbering numbering_;
  RecentCorners recent_;
  std::size_t facets_ = 0;  // before this batch
  std::array<Corner, 3 * kFacetsAtATime> corners_;
  std::array<Index, 3 * kFacetsAtATime> numbers_;
  std::array<std::uint32_t, 3 * kFacetsAtATime> unknown_corners_;
  std::vector<Point> unknown_;
};

// Facets of a binary file that holds `size` bytes.
std::size_t facet_count(std::string_view head, std::uint64_t size, const ReadContext& context) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorCode::BadData, why, {context.name, 0, 0, ""});
  };
  if (size < kHeaderBytes) refuse("cut short: a binary STL file has a header of 84 bytes");
  const std::uint64_t declared = declared_facets(head);
  if (declared > (size - kHeaderBytes) / kFacetBytes) {
    refuse(fmt::format("neither a text STL file nor a whole binary one: {} facets declared, room for {}",
                       declared, (size - kHeaderBytes) / kFacetBytes));
  }
  return static_cast<std::size_t>(declared);
}

void warn_of_rest(std::uint64_t size, std::size_t facets, const ReadContext& context, Model& model) {
  const std::uint64_t rest = size - kHeaderBytes - facets * kFacetBytes;
  if (rest == 0) return;
  model.diagnostics.push_back({Diagnostic::Severity::Warning,
                               fmt::format("{} bytes after the last facet, left out", rest),
                               {context.name, 0, 0, ""},
                               1});
}

Model read_binary(std::string_view bytes, const ReadContext& context) {
  const std::size_t count = facet_count(bytes, bytes.size(), context);
  BinaryFacets facets(count, context);
  facets.add(bytes.substr(kHeaderBytes, count * kFacetBytes));
  Model model = std::move(facets).finish();
  warn_of_rest(bytes.size(), count, context, model);
  return model;
}

// Reads "solid NAME, facet ..., endsolid NAME", any number of times. Words may be in either case.
class TextSolids {
 public:
  TextSolids(std::string_view bytes, const ReadContext& context) : in_(bytes, context.name), mesh_(context) {}

  Model read() && {
    while (!in_.at_end()) read_solid();
    number_corners();
    mesh_.points = std::move(numbering_).take_points();
    return std::move(mesh_).finish();
  }

 private:
  void expect(std::string_view lower) {
    if (!same_word(in_.peek(), lower)) {
      in_.fail(fmt::format("expected '{}', found '{}'", lower, printable(in_.peek(), 40)));
    }
    in_.word();
  }

  void read_solid() {
    expect("solid");
    mesh_.groups.push_back({std::string(in_.rest_of_line()), Rgba{}});
    group_ = static_cast<Index>(mesh_.groups.size() - 1);
    while (!same_word(in_.peek(), "endsolid")) read_facet();
    in_.rest_of_line();
  }

  void read_facet() {
    expect("facet");
    in_.rest_of_line();  // the normal, which may be anything
    expect("outer");
    expect("loop");
    for (int corner = 0; corner < 3; ++corner) {
      expect("vertex");
      const double x = in_.number(), y = in_.number(), z = in_.number();
      corners_.push_back({x, y, z});
    }
    expect("endloop");
    expect("endfacet");
    facet_groups_.push_back(group_);
    if (facet_groups_.size() == kFacetsAtATime) number_corners();
  }

  void number_corners() {
    numbers_.resize(corners_.size());
    numbering_.add(corners_, numbers_);
    for (std::size_t i = 0; i < facet_groups_.size(); ++i) {
      mesh_.add_triangle({numbers_[3 * i], numbers_[3 * i + 1], numbers_[3 * i + 2]}, facet_groups_[i]);
    }
    corners_.clear();
    facet_groups_.clear();
  }

  TextCursor in_;
  PolygonMesh mesh_;
  PointNumbering numbering_;
  Index group_ = 0;
  std::vector<Point> corners_;
  std::vector<Index> numbers_, facet_groups_;
};

}  // namespace

Match sniff_stl(std::string_view head, std::uint64_t size) {
  if (is_binary(head, size)) return Match::Sure;
  if (starts_as_text(head)) return Match::Sure;
  const auto is_text = [](char c) { return c == '\t' || c == '\n' || c == '\r' || (c >= ' ' && c <= '~'); };
  return head.size() >= kHeaderBytes && !std::ranges::all_of(head, is_text) ? Match::IfNamed : Match::No;
}

Model read_stl(std::string_view bytes, const ReadContext& context) {
  if (!is_binary(bytes, bytes.size()) && starts_as_text(bytes)) return TextSolids(bytes, context).read();
  return read_binary(bytes, context);
}

Model read_stl_file(InputFile& file, const ReadContext& context) {
  if (!is_binary(file.head(), file.size())) return read_stl(file.read().view(), context);
  const std::size_t count = facet_count(file.head(), file.size(), context);
  BinaryFacets facets(count, context);
  std::vector<char> part(std::min(count, kFacetsInPart) * kFacetBytes);
  for (std::size_t done = 0; done < count; done += kFacetsInPart) {
    const std::size_t size = std::min(kFacetsInPart, count - done) * kFacetBytes;
    if (file.read_at(part.data(), size, kHeaderBytes + done * kFacetBytes) < size) {
      throw Error(ErrorCode::BadData, "cut short while it was read", {context.name, 0, 0, ""});
    }
    facets.add({part.data(), size});
  }
  return std::move(facets).finish();
}

}  // namespace meshcontour::detail

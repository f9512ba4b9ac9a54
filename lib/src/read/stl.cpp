#include "read/stl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

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

// The numbers of the corners of facets, read in pieces that stay in the cache.
class BinaryFacets {
 public:
  BinaryFacets(std::string_view facets, const ReadContext& context)
      : facets_(facets), context_(context), numbering_(facets.size() / kFacetBytes / 2) {}

  Model read() && {
    PolygonMesh mesh(context_);
    const std::size_t count = facets_.size() / kFacetBytes;
    mesh.reserve_triangles(count);
    for (std::size_t first = 0; first < count; first += kFacetsAtATime) {
      const std::size_t size = std::min(kFacetsAtATime, count - first);
      read_corners(first, size);
      numbering_.add(std::span(corners_).first(3 * size), numbers_);
      for (std::size_t i = 0; i < size; ++i) {
        mesh.add_triangle({numbers_[3 * i], numbers_[3 * i + 1], numbers_[3 * i + 2]});
      }
    }
    mesh.points = std::move(numbering_).take_points();
    return std::move(mesh).finish();
  }

 private:
  void read_corners(std::size_t first, std::size_t size) {
    std::array<float, 9> coordinates;
    for (std::size_t i = 0; i < size; ++i) {
      std::memcpy(coordinates.data(), facets_.data() + (first + i) * kFacetBytes + kNormalBytes,
                  sizeof coordinates);
      for (std::size_t k = 0; k < 3; ++k) {
        corners_[3 * i + k] = Point(coordinates[3 * k], coordinates[3 * k + 1], coordinates[3 * k + 2]);
        if (!corners_[3 * i + k].allFinite()) {
          throw Error(ErrorCode::BadData, "a coordinate is not finite",
                      {context_.name, 0, 0, fmt::format("facet {}", first + i + 1)});
        }
      }
    }
  }

  std::string_view facets_;
  const ReadContext& context_;
  PointNumbering numbering_;
  std::array<Point, 3 * kFacetsAtATime> corners_;
  std::array<Index, 3 * kFacetsAtATime> numbers_;
};

Model read_binary(std::string_view bytes, const ReadContext& context) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorCode::BadData, why, {context.name, 0, 0, ""});
  };
  if (bytes.size() < kHeaderBytes) refuse("cut short: a binary STL file has a header of 84 bytes");
  const std::uint64_t declared = declared_facets(bytes);
  const std::string_view facets = bytes.substr(kHeaderBytes);
  if (declared > facets.size() / kFacetBytes) {
    refuse(fmt::format("neither a text STL file nor a whole binary one: {} facets declared, room for {}",
                       declared, facets.size() / kFacetBytes));
  }
  const std::size_t used = static_cast<std::size_t>(declared) * kFacetBytes;
  Model model = BinaryFacets(facets.substr(0, used), context).read();
  if (used < facets.size()) {
    model.diagnostics.push_back({Diagnostic::Severity::Warning,
                                 fmt::format("{} bytes after the last facet, left out", facets.size() - used),
                                 {context.name, 0, 0, ""},
                                 1});
  }
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

}  // namespace meshcontour::detail

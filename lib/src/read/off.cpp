#include "read/off.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/text_cursor.hpp"
#include "read/numbered_groups.hpp"
#include "read/polygon_mesh.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::size_t kLeastVertexBytes = 6;  // "0 0 0" and a line end
constexpr std::size_t kLeastFaceBytes = 2;

// "OFF" behind any of ST, C and N, in this order; nothing if the word is not such a keyword.
bool is_off_keyword(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"}) {
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  }
  return word == "OFF";
}

class OffReader {
 public:
  OffReader(std::string_view bytes, const ReadContext& context)
      : in_(bytes, context.name, '#'), mesh_(context), colors_(mesh_) {}

  Model read() && {
    read_header();
    for (std::size_t i = 0; i < vertices_; ++i) {
      const double x = in_.number(), y = in_.number(), z = in_.number();
      mesh_.points.push_back({x, y, z});
      in_.rest_of_line();  // normal, colour and texture coordinates
    }
    for (std::size_t i = 0; i < faces_; ++i) read_face();
    if (!in_.at_end())
      mesh_.note(Diagnostic::Severity::Warning, "text after the last face, left out", in_.spot());
    return std::move(mesh_).finish();
  }

 private:
  std::size_t count(std::string_view what, std::size_t least_bytes) {
    const auto declared =
        static_cast<std::uint64_t>(in_.integer(0, std::numeric_limits<std::int64_t>::max()));
    if (declared > in_.remaining() / least_bytes + 1) {
      in_.fail(fmt::format("{} {} declared, but only {} bytes follow", declared, what, in_.remaining()));
    }
    return static_cast<std::size_t>(declared);
  }

  void read_header() {
    const std::string_view word = in_.peek();
    if (is_off_keyword(word)) {
      in_.word();
      if (in_.peek() == "BINARY") in_.fail("binary OFF is not supported");
    } else if (!parse_integer<std::uint64_t>(word)) {
      in_.fail(fmt::format("expected 'OFF', found '{}'", printable(word, 40)));
    }
    vertices_ = count("vertices", kLeastVertexBytes);
    faces_ = count("faces", kLeastFaceBytes);
    in_.rest_of_line();  // the edges, which nobody counts
    mesh_.points.reserve(vertices_);
  }

  void read_face() {
    const std::size_t size = count("corners", kLeastFaceBytes);
    corners_.clear();
    for (std::size_t i = 0; i < size; ++i) corners_.push_back(in_.index(vertices_));
    mesh_.add_polygon(corners_, {}, read_color());
  }

  // Nothing, an index into a colour map that nobody has, or 3 or 4 numbers: from 0 to 255, or with a point
  // to 1.
  Index read_color() {
    std::array<double, 4> channels = {0, 0, 0, 255};
    std::size_t found = 0;
    bool fractions = false;
    for (; !in_.at_line_end(); ++found) {
      const std::string_view word = in_.peek();
      const double value = in_.number();
      if (found < 4) channels[found] = value;
      fractions = fractions || (found < 3 && word.find('.') != std::string_view::npos);
    }
    if (found == 1 && std::abs(channels[0]) < 1e9)
      return colors_.group(-1 - std::llround(channels[0]), Rgba{});
    if (found != 3 && found != 4) return colors_.group(color_key(Rgba{}), Rgba{});
    std::array<std::uint8_t, 4> bytes{};
    for (std::size_t i = 0; i < 4; ++i) {
      bytes[i] =
          static_cast<std::uint8_t>(std::lround(std::clamp(channels[i] * (fractions ? 255 : 1), 0.0, 255.0)));
    }
    const Rgba color{bytes[0], bytes[1], bytes[2], bytes[3]};
    return colors_.group(color_key(color), color);
  }

  TextCursor in_;
  PolygonMesh mesh_;
  NumberedGroups colors_;
  std::size_t vertices_ = 0, faces_ = 0;
  std::vector<Index> corners_;
};

}  // namespace

Match sniff_off(std::string_view head, std::uint64_t) {
  TextCursor in(head, "", '#');
  const std::string_view word = in.peek();
  if (is_off_keyword(word)) return Match::Sure;
  return parse_integer<std::uint64_t>(word) ? Match::Possible : Match::No;
}

Model read_off(std::string_view bytes, const ReadContext& context) {
  return OffReader(bytes, context).read();
}

}  // namespace meshcontour::detail

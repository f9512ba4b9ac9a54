#include "read/webxml_scan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "read/fast_number.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::size_t kPieceSize = std::size_t{256} << 10;
constexpr std::size_t kBlock = 512;
constexpr std::size_t kLane = 128;  // counts of a lane fit a byte, which lets the compiler use byte vectors

struct Names {
  std::string_view item, closing;
};

Names names_of(BodyKind kind) {
  switch (kind) {
    case BodyKind::Vertices:
      return {"<v", "</verts>"};
    case BodyKind::Facets:
      return {"<f", "</facets>"};
    case BodyKind::Polyline:
      return {"<p", "</polyline>"};
  }
  return {};
}

struct BlockCount {
  std::size_t items = 0, normals = 0;
  bool closing = false;
};

// Counts in kBlock bytes; the three bytes after them are looked at too.
BlockCount count_block(const char* text, const Names& names) {
  const char item = names.item[1], first = names.closing[2], second = names.closing[3];
  BlockCount count;
  std::uint8_t closing = 0;
  for (std::size_t lane = 0; lane < kBlock; lane += kLane) {
    std::uint8_t items = 0, normals = 0;
    for (std::size_t i = lane; i < lane + kLane; ++i) {
      const std::uint8_t tag = text[i] == '<';
      items = static_cast<std::uint8_t>(items + (tag & (text[i + 1] == item)));
      normals = static_cast<std::uint8_t>(normals + (tag & (text[i + 1] == 'n')));
      closing = static_cast<std::uint8_t>(
          closing | (tag & (text[i + 1] == '/') & (text[i + 2] == first) & (text[i + 3] == second)));
    }
    count.items += items;
    count.normals += normals;
  }
  count.closing = closing != 0;
  return count;
}

// The same for what is left before the closing tag, or before the end of the text.
BlockCount count_rest(std::string_view text, const Names& names) {
  BlockCount count;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (text[i] != '<') continue;
    count.items += text[i + 1] == names.item[1];
    count.normals += text[i + 1] == 'n';
  }
  return count;
}

// The first item at or after an offset, if it is near and belongs to the same body.
std::optional<std::size_t> next_item(TextWindow& window, std::size_t offset, const Names& names) {
  window.show(offset, kBlock);
  const std::string_view near = window.part(offset, std::min(offset + kBlock, window.end()));
  const std::size_t item = near.find(names.item);
  if (item == near.npos || near.substr(0, item).find(names.closing) != near.npos) return std::nullopt;
  return offset + item;
}

// Moves a cursor over a plain body. Nothing is checked for the end of the piece: its closing tag stops
// everything.
struct Cursor {
  const char* p;
  const char* end;

  void skip_space() {
    while (true) {
      if (*p == ' ') {
        const std::uint64_t others = load_eight(p) ^ 0x2020202020202020u;
        p += others == 0 ? 8 : std::countr_zero(others) / 8;
      } else if (*p == '\n' || *p == '\r' || *p == '\t') {
        ++p;
      } else {
        return;
      }
    }
  }

  template <std::size_t N>
  bool take(const char (&literal)[N]) {
    if (std::memcmp(p, literal, N - 1) != 0) return false;
    p += N - 1;
    return true;
  }

  bool take(char c) {
    const bool found = *p == c;
    p += found;
    return found;
  }

  // x y z, up to and with the quote
  bool take_vector(Vector& v) {
    return scan_number(p, end, v[0]) && take(' ') && scan_number(p, end, v[1]) && take(' ') &&
           scan_number(p, end, v[2]) && take('"');
  }

  bool take_triangle(Triangle& t) {
    return scan_index(p, t[0]) && take(' ') && scan_index(p, t[1]) && take(' ') && scan_index(p, t[2]) &&
           take('"');
  }

  // Up to and with the quote; false at what must not or need not stand in a value.
  bool skip_value() {
    while (*p != '"') {
      const auto c = static_cast<unsigned char>(*p);
      if (c == '<' || c == '&' || c < 0x20 || c >= 0x80) return false;
      ++p;
    }
    ++p;
    return true;
  }

  // None or three, and the end tag of their facet.
  bool take_normals(Vector* normals) {
    skip_space();
    if (take("</f>")) return true;
    if (normals == nullptr) return false;
    for (int corner = 0; corner < 3; ++corner) {
      Vector v;
      if (!take("<n d=\"") || !take_vector(v) || !take("/>")) return false;
      normals[corner] = unit_or_zero(v);
      skip_space();
    }
    return take("</f>");
  }
};

bool is_usual(const Point& p) {
  return p.cwiseAbs().maxCoeff() <= kUsualCoordinate;
}

template <std::size_t N>
bool scan_point_items(Cursor& in, const char (&open)[N], std::span<Point> points) {
  for (Point& point : points) {
    in.skip_space();
    if (!in.take(open) || !in.take_vector(point) || !in.take("/>") || !is_usual(point)) return false;
  }
  in.skip_space();
  return in.p == in.end;
}

}  // namespace

std::optional<BodyOutline> outline_body(TextWindow& window, std::size_t begin, BodyKind kind) {
  const Names names = names_of(kind);
  constexpr std::size_t kBehind = 16;  // a closing tag may begin in the last byte of a block
  BodyOutline outline;
  BodyPiece piece{begin, begin, 0, 0};
  std::size_t at = begin;
  for (;; at += kBlock) {
    if (at - piece.begin >= kPieceSize) {
      if (const auto cut = next_item(window, at, names)) {
        outline.pieces.push_back({piece.begin, *cut, piece.first_item, outline.items - piece.first_item});
        piece = {*cut, *cut, outline.items, 0};
      }
    }
    window.show(at, kBlock + kBehind);
    if (window.end() < at + kBlock + kBehind) break;
    const std::string_view block = window.part(at, at + kBlock + kBehind);
    const BlockCount count = count_block(block.data(), names);
    if (count.closing && block.find(names.closing) != block.npos) break;
    outline.items += count.items;
    outline.normals += count.normals;
  }
  const std::string_view rest = window.part(at, window.end());
  const std::size_t length = rest.find(names.closing);
  if (length == rest.npos) return std::nullopt;
  const BlockCount count = count_rest(rest.substr(0, length), names);
  outline.end = piece.end = at + length;
  outline.items += count.items;
  outline.normals += count.normals;
  piece.items = outline.items - piece.first_item;
  outline.pieces.push_back(piece);
  return outline;
}

std::string_view piece_text(const TextSource& source, const BodyPiece& piece, std::string& buffer) {
  const std::string_view seen = source.view(piece.begin, piece.end + TextSource::kGuard, buffer);
  return seen.substr(0, piece.end - piece.begin);
}

bool scan_points(std::string_view piece, BodyKind kind, std::span<Point> points) {
  Cursor in{piece.data(), piece.data() + piece.size()};
  return kind == BodyKind::Vertices ? scan_point_items(in, "<v p=\"", points)
                                    : scan_point_items(in, "<p l=\"", points);
}

bool scan_facets(std::string_view piece, std::span<Triangle> triangles, std::span<Vector> normals,
                 Index& highest) {
  Cursor in{piece.data(), piece.data() + piece.size()};
  Vector* corner = normals.data();
  for (Triangle& triangle : triangles) {
    in.skip_space();
    if (!in.take("<f v=\"") || !in.take_triangle(triangle)) return false;
    highest = std::max({highest, triangle[0], triangle[1], triangle[2]});
    if (in.take(" fn=\"") && !in.skip_value()) return false;
    if (corner != nullptr) std::fill_n(corner, 3, Vector::Zero());
    if (!in.take("/>") && (!in.take('>') || !in.take_normals(corner))) return false;
    if (corner != nullptr) corner += 3;
  }
  in.skip_space();
  return in.p == in.end;
}

Vector unit_or_zero(const Vector& v) {
  const double square = v.squaredNorm();
  if (std::abs(square - 1) <= 1e-12) return v;
  const double length = v.stableNorm();
  return length > 0 && std::isfinite(length) ? Vector(v / length) : Vector(Vector::Zero());
}

}  // namespace meshcontour::detail

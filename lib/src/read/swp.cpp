#include "read/swp.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "base/line_counter.hpp"
#include "base/text_cursor.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kLargest = 1e100;  // of a coordinate, so that volumes do not overflow
constexpr std::array<std::string_view, 7> kTypes = {"bez2", "bez3", "bsp2", "bsp3", "circ", "srev", "gcyl"};

bool is_type(std::string_view word) {
  return std::ranges::find(kTypes, word) != kTypes.end();
}

std::string in_quotes(std::string_view word) {
  return fmt::format("'{}'", printable(word, 40));
}

/// Splits the text into words; brackets end a word, except in names.
class Scanner {
 public:
  Scanner(std::string_view text, const std::string& name) : text_(text), cursor_(text, name), name_(name) {}

  bool at_end() { return cursor_.at_end(); }

  /// A run of characters other than blanks.
  std::string_view name(const char* expected) { return take(next(expected).size()); }

  std::uint64_t integer(const char* what, std::uint64_t least) {
    const std::string_view token = bracketless(what);
    const auto value = parse_integer<std::uint64_t>(token);
    const bool digits = token.find_first_not_of("0123456789") == std::string_view::npos;
    if (!value && !digits)
      fail("bad-integer", fmt::format("expected {}, an integer, found {}", what, in_quotes(token)));
    if (!value || *value < least || *value > std::numeric_limits<std::uint32_t>::max()) {
      fail("out-of-range", fmt::format("expected {} from {} to {}, found {}", what, least,
                                       std::numeric_limits<std::uint32_t>::max(), in_quotes(token)));
    }
    return *value;
  }

  double number(const char* what, double least) {
    const std::string_view token = bracketless(what);
    const auto value = parse_number(token);
    if (!value)
      fail("bad-number", fmt::format("expected {}, a finite number, found {}", what, in_quotes(token)));
    if (*value < least || *value > kLargest) {
      fail("out-of-range",
           fmt::format("expected {} from {} to {}, found {}", what, least, kLargest, in_quotes(token)));
    }
    return *value;
  }

  void bracket(char c) {
    const std::string_view word = next(c == '[' ? "'['" : "']'");
    if (word.front() != c) {
      start_ = cursor_.offset();
      fail("expected-bracket", fmt::format("expected '{}', found {}", c, in_quotes(up_to_bracket(word))));
    }
    take(1);
  }

  /// Place of what was taken last.
  Spot spot(const std::string& element) {
    Spot spot{name_, lines_.line(start_), lines_.column(start_), element};
    return spot;
  }

  [[noreturn]] void fail(const char* code, const std::string& message) {
    throw Error(ErrorCode::BadData, fmt::format("{} [{}]", message, code), spot(""));
  }

 private:
  std::string_view next(const char* expected) {
    const std::string_view word = cursor_.peek();
    if (!word.empty()) return word;
    start_ = end_;
    fail("unexpected-end", fmt::format("expected {}, found the end of the file", expected));
  }

  // At least one character, so that a bracket in the wrong place is seen.
  static std::string_view up_to_bracket(std::string_view word) {
    return word.substr(0, std::max<std::size_t>(1, std::min(word.find_first_of("[]"), word.size())));
  }

  std::string_view bracketless(const char* expected) { return take(up_to_bracket(next(expected)).size()); }

  std::string_view take(std::size_t size) {
    start_ = cursor_.offset();
    end_ = start_ + size;
    cursor_.skip_to(end_);
    return text_.substr(start_, size);
  }

  std::string_view text_;
  TextCursor cursor_;
  const std::string& name_;
  LineCounter lines_{TextSource(text_)};
  std::size_t start_ = 0, end_ = 0;  // of what was taken last
};

class Parser {
 public:
  Parser(std::string_view bytes, const std::string& name) : in_(bytes, name) {}

  SweepScene parse() {
    while (!in_.at_end()) object();
    return std::move(scene_);
  }

 private:
  struct Entry {
    bool is_curve;
    std::size_t index;
  };

  void object() {
    const std::string_view type = in_.name("an object");
    Spot spot = in_.spot(std::string(type));
    if (!is_type(type) && in_.at_end()) unknown_type(type, spot);
    const std::string_view name = in_.name("a name");
    if (name != "." && entries_.contains(name)) {
      in_.fail("duplicate-name", fmt::format("expected a new name, found {} again", in_quotes(name)));
    }
    if (!is_type(type)) unknown_type(type, spot);
    if (name != ".") spot.element = fmt::format("{} {}", type, name);
    const bool is_curve = type != "srev" && type != "gcyl";
    const std::size_t index = is_curve ? scene_.curves.size() : scene_.surfaces.size();
    if (is_curve) {
      curve(type, name, spot);
    } else {
      surface(type, name, spot);
    }
    if (name != ".") entries_.emplace(name, Entry{is_curve, index});
  }

  [[noreturn]] static void unknown_type(std::string_view type, Spot spot) {
    spot.element.clear();
    throw Error(
        ErrorCode::BadData,
        fmt::format("expected one of {}, found {} [unknown-type]", fmt::join(kTypes, " "), in_quotes(type)),
        spot);
  }

  void curve(std::string_view type, std::string_view name, const Spot& spot) {
    SweepCurve curve;
    if (name != ".") curve.name = name;
    curve.spot = spot;
    curve.planar = type.back() != '3';
    curve.steps = in_.integer("a number of steps", 1);
    if (type == "circ") {
      curve.kind = SweepCurve::Kind::Circle;
      curve.radius = in_.number("a radius", 0);
    } else {
      curve.kind = type.starts_with("bez") ? SweepCurve::Kind::Bezier : SweepCurve::Kind::BSpline;
      control_points(curve);
    }
    scene_.curves.push_back(std::move(curve));
  }

  void control_points(SweepCurve& curve) {
    const bool bezier = curve.kind == SweepCurve::Kind::Bezier;
    const std::uint64_t count = in_.integer("a number of control points", bezier ? 0 : 4);
    if (bezier && (count < 4 || count % 3 != 1)) {
      in_.fail("bad-count", fmt::format("expected 4, 7, 10, ... control points, found {}", count));
    }
    // No memory is taken for points that the file only promises.
    for (std::uint64_t i = 0; i < count; ++i) {
      Point p = Point::Zero();
      in_.bracket('[');
      for (int axis = 0; axis < (curve.planar ? 2 : 3); ++axis)
        p[axis] = in_.number("a coordinate", -kLargest);
      in_.bracket(']');
      curve.control_points.push_back(p);
    }
  }

  void surface(std::string_view type, std::string_view name, const Spot& spot) {
    SweepSurface surface;
    if (name != ".") surface.name = name;
    surface.spot = spot;
    const bool revolved = type == "srev";
    surface.kind = revolved ? SweepSurface::Kind::Revolution : SweepSurface::Kind::Cylinder;
    if (revolved) surface.steps = in_.integer("a number of steps", 3);
    surface.profile = reference("a profile");
    if (!scene_.curves[surface.profile].planar) {
      in_.fail("profile-not-2d", fmt::format("expected a profile of two dimensions, found {}",
                                             in_quotes(scene_.curves[surface.profile].name)));
    }
    if (!revolved) surface.sweep = reference("a sweep");
    scene_.surfaces.push_back(std::move(surface));
  }

  std::size_t reference(const char* what) {
    const std::string_view name = in_.name(what);
    const auto entry = entries_.find(name);
    if (entry == entries_.end() || !entry->second.is_curve) {
      in_.fail("unknown-curve",
               fmt::format("expected {}, the name of a curve given before, found {}", what, in_quotes(name)));
    }
    return entry->second.index;
  }

  Scanner in_;
  SweepScene scene_;
  std::unordered_map<std::string_view, Entry> entries_;
};

}  // namespace

SweepScene parse_swp(std::string_view bytes, const std::string& name) {
  return Parser(bytes, name).parse();
}

Match sniff_swp(std::string_view head, std::uint64_t) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  bool first = true, found = false;
  while (!found) {
    head.remove_prefix(std::min(head.find_first_not_of(kBlanks), head.size()));
    if (head.empty()) break;
    const std::string_view word = head.substr(0, head.find_first_of(kBlanks));
    if (first && is_type(word)) return Match::Sure;
    std::string lower(word);
    for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    found = is_type(lower);
    first = false;
    head.remove_prefix(word.size());
  }
  return found ? Match::Possible : Match::No;
}

Model read_swp(std::string_view bytes, const ReadContext& context) {
  SweepOptions options = context.options.sweep;
  options.max_triangles = std::min(options.max_triangles, context.options.max_triangles);
  options.threads = context.options.threads;
  return sweep(parse_swp(bytes, context.name), options);
}

}  // namespace meshcontour::detail

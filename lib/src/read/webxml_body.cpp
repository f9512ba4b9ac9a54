#include "read/webxml_body.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>

#include "base/line_counter.hpp"
#include "base/text_cursor.hpp"
#include "read/xml_digest.hpp"
#include "read/xml_scanner.hpp"
#include "read/xml_words.hpp"

namespace meshcontour::detail {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kChunkSize = std::size_t{256} << 10;
constexpr std::size_t kBodyDepth = 3;  // the usual: document element, shell, body

// An element of a body with its line in the file.
using Visitor = std::function<void(const XMLElement&, std::size_t line)>;

// Gives tinyxml2 whole elements of the body, about a chunk at a time.
class BodyWalk {
 public:
  BodyWalk(const BodySource& body, Findings& findings)
      : body_(body), findings_(findings), source_(body.text), digest_(source_, 0, body.line) {}

  void visit(const Visitor& visitor) {
    TextWindow window(source_);
    XmlScanner scanner(window, body_.file, 0, kBodyDepth);
    begin_chunk(0);
    while (true) {
      const XmlToken token = scanner.next();
      if (token.kind == XmlToken::Kind::EndOfFile) break;
      const std::string_view bytes = window.part(token.begin, token.end);
      if (token.kind == XmlToken::Kind::Text || token.kind == XmlToken::Kind::CharacterData) {
        report_text(token.begin, bytes);
      }
      digest_.append(token.kind, bytes);
      if (scanner.depth() == kBodyDepth && digest_.text().size() > kChunkSize) {
        end_chunk(visitor);
        begin_chunk(token.end);
      }
    }
    end_chunk(visitor);
  }

 private:
  void begin_chunk(std::size_t offset) {
    digest_.restart(offset);
    digest_.text() = "<body>";
  }

  void end_chunk(const Visitor& visitor) {
    digest_.text() += "</body>";
    tinyxml2::XMLDocument document;
    parse_digest(document, digest_, body_.file);
    for (const XMLElement* e = document.RootElement()->FirstChildElement(); e != nullptr;
         e = e->NextSiblingElement()) {
      visitor(*e, digest_.line(e->GetLineNum()));
    }
  }

  void report_text(std::size_t offset, std::string_view bytes) {
    const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
    if (begin == bytes.npos) return;
    findings_.note("text", [&] {
      LineCounter lines(source_, 0, body_.line);
      return std::pair("text between elements is not read",
                       Spot{body_.file, lines.line(offset + begin), 0, body_.element});
    });
  }

  const BodySource& body_;
  Findings& findings_;
  TextSource source_;
  XmlDigest digest_;
};

// An element of a body, and how a message names it.
struct Place {
  const BodySource& source;
  const XMLElement& element;
  std::size_t line;

  Spot spot() const {
    return {source.file, line, 0, fmt::format("{}, {}", source.element, printable(element.Name(), 40))};
  }
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorCode::BadData, message, spot());
  }

  // The words of an attribute, which must be there.
  std::vector<std::string_view> words(const char* attribute) const {
    const char* value = element.Attribute(attribute);
    if (value == nullptr) fail(fmt::format("attribute {} is missing", attribute));
    return xml_words(value);
  }
};

void report_unexpected(const Place& place, Findings& findings) {
  findings.warn("element", [&] {
    const std::string name = printable(place.element.Name(), 40);
    return std::pair(fmt::format("<{}> does not belong here and is left out", name),
                     Spot{place.source.file, place.line, 0, place.source.element});
  });
}

double coordinate_of(const Place& place, const char* attribute, std::string_view word, Findings& findings) {
  const auto number = parse_number(word);
  if (!number) place.fail(fmt::format("{}: '{}' is not a finite number", attribute, printable(word, 40)));
  if (std::abs(*number) > kLargestCoordinate) {
    place.fail(fmt::format("{}: {} is beyond {}", attribute, *number, kLargestCoordinate));
  }
  if (std::abs(*number) > kUsualCoordinate) {
    findings.warn("far", [&] {
      return std::pair(fmt::format("{}: {} is far from anything a model usually holds", attribute, *number),
                       place.spot());
    });
  }
  return *number;
}

Point point_of(const Place& place, BodyKind kind, Findings& findings) {
  const char* const attribute = kind == BodyKind::Vertices ? "p" : "l";
  const auto words = place.words(attribute);
  const bool with_axis = kind == BodyKind::Polyline && words.size() == 6;  // as tool paths have it
  if (words.size() != 3 && !with_axis) {
    place.fail(fmt::format("{} needs 3 numbers, found {}", attribute, words.size()));
  }
  Point point;
  for (int k = 0; k < 3; ++k)
    point[k] = coordinate_of(place, attribute, words[static_cast<std::size_t>(k)], findings);
  return point;
}

Triangle triangle_of(const Place& place, std::size_t point_count) {
  const auto words = place.words("v");
  if (words.size() != 3) place.fail(fmt::format("v needs 3 indices, found {}", words.size()));
  Triangle triangle;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string word = printable(words[k], 40);
    if (words[k].find_first_not_of("0123456789") != std::string_view::npos) {
      place.fail(fmt::format("v: '{}' is not an index", word));
    }
    const auto index = parse_integer<std::uint64_t>(words[k]);
    if (!index || *index >= point_count)
      place.fail(fmt::format("v: index {}, {} vertices", word, point_count));
    triangle[k] = static_cast<Index>(*index);
  }
  return triangle;
}

// The normals of a facet's corners; zero where there is none. False if there was no <n>.
bool normals_of(const Place& facet, Findings& findings, std::array<Vector, 3>& normals) {
  normals.fill(Vector::Zero());
  std::size_t count = 0;
  for (const XMLElement* e = facet.element.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    const auto below = static_cast<std::size_t>(e->GetLineNum() - facet.element.GetLineNum());
    const Place place{facet.source, *e, facet.line + below};
    if (std::string_view(e->Name()) != "n") {
      report_unexpected(place, findings);
      continue;
    }
    const char* value = e->Attribute("d");
    const auto direction = value == nullptr ? std::nullopt : xml_vector(value);
    if (!direction) {
      findings.warn("normal",
                    [&] { return std::pair("a normal without three numbers is left out", place.spot()); });
    }
    if (direction && count < 3) normals[count] = unit_or_zero(*direction);
    ++count;
  }
  if (count != 0 && count != 3) {
    findings.warn("normals", [&] {
      return std::pair(fmt::format("{} corner normals where 3 belong", count), facet.spot());
    });
  }
  return count > 0;
}

}  // namespace

std::vector<Point> parse_points(const BodySource& source, BodyKind kind, Findings& findings) {
  const char* const item = kind == BodyKind::Vertices ? "v" : "p";
  std::vector<Point> points;
  BodyWalk(source, findings).visit([&](const XMLElement& element, std::size_t line) {
    const Place place{source, element, line};
    if (std::string_view(element.Name()) != item) return report_unexpected(place, findings);
    points.push_back(point_of(place, kind, findings));
  });
  return points;
}

FacetData parse_facets(const BodySource& source, std::size_t point_count, Findings& findings) {
  FacetData data;
  BodyWalk(source, findings).visit([&](const XMLElement& element, std::size_t line) {
    const Place place{source, element, line};
    if (std::string_view(element.Name()) != "f") return report_unexpected(place, findings);
    data.triangles.push_back(triangle_of(place, point_count));
    std::array<Vector, 3> normals;
    if (normals_of(place, findings, normals) || !data.normals.empty()) {
      data.normals.resize(3 * (data.triangles.size() - 1), Vector::Zero());
      data.normals.insert(data.normals.end(), normals.begin(), normals.end());
    }
  });
  return data;
}

}  // namespace meshcontour::detail

#include "read/webxml_scan.hpp"

#include <fmt/format.h>

#include <string>

#include "read/webxml_body.hpp"
#include "support/catch.hpp"
#include "unit/read/webxml_text.hpp"

using namespace meshcontour;
using namespace meshcontour::detail;

namespace {

std::optional<BodyOutline> outlined(const std::string& text, std::size_t begin, BodyKind kind) {
  const TextSource source(text);
  TextWindow window(source);
  return outline_body(window, begin, kind);
}

// A body of many facets, some with normals, and its closing tag.
std::string facets_body(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text += fmt::format("      <f v=\"{} {} {}\" fn=\"0 0 {}\"", i, i + 1, i * 7919 % (count + 2), i % 2);
    text += i % 5 == 4 ? "/>\n" : ">\n<n d=\"0 0 1\"/>\n<n d=\"0.6 0.8 0\"/>\n<n d=\"0 -3 4\"/></f>\n";
  }
  return text + "</facets>";
}

// Scans all pieces.
bool scan_all(const std::string& text, const BodyOutline& outline, std::vector<Triangle>& triangles,
              std::vector<Vector>& normals) {
  triangles.resize(outline.items);
  normals.resize(outline.normals > 0 ? 3 * outline.items : 0);
  Index highest = 0;
  const TextSource source(text);
  std::string buffer;
  for (const BodyPiece& piece : outline.pieces) {
    const auto corners = normals.empty() ? std::span<Vector>()
                                         : std::span(normals).subspan(3 * piece.first_item, 3 * piece.items);
    if (!scan_facets(piece_text(source, piece, buffer),
                     std::span(triangles).subspan(piece.first_item, piece.items), corners, highest))
      return false;
  }
  return true;
}

}  // namespace

TEST_CASE("outline_body: pieces cover the body between items, and the scan agrees with tinyxml2", "[read]") {
  const std::size_t count = GENERATE(0u, 1u, 3u, 50u, 2000u, 9000u);
  const std::string text = "<facets>" + facets_body(count) + " </shell> <facets> <f </facets>";
  const auto outline = outlined(text, 8, BodyKind::Facets);
  REQUIRE(outline);
  CHECK(outline->end == text.find("</facets>"));
  CHECK(outline->items == count);
  CHECK(outline->pieces.size() >= text.size() / 600'000);
  std::size_t at = 8, item = 0;
  for (const BodyPiece& piece : outline->pieces) {
    CHECK(piece.begin == at);
    CHECK(piece.first_item == item);
    at = piece.end;
    item += piece.items;
  }
  CHECK(at == outline->end);
  CHECK(item == count);

  std::vector<Triangle> triangles;
  std::vector<Vector> normals;
  REQUIRE(scan_all(text, *outline, triangles, normals));
  Findings findings;
  const std::string file = "f";
  const std::string_view body = std::string_view(text).substr(8, outline->end - 8);
  const FacetData parsed = parse_facets({body, 1, file, "shell"}, count + 10, findings);
  CHECK(parsed.triangles == triangles);
  CHECK(parsed.normals == normals);
  CHECK(findings.diagnostics().empty());
}

TEST_CASE("scan_facets: anything but the plain form is left to the other way", "[read]") {
  const std::string facet = GENERATE(
      "<f v='0 1 2'/>", "<f  v=\"0 1 2\"/>", "<f v=\"0  1 2\"/>", "<f v=\"0 1\"/>", "<f v=\"0 1 2 3\"/>",
      "<f v=\"0 1 2 \"/>", "<f v=\"0 1 2\" />", "<f v=\"0 1 2\"><n d=\"0 0 1\"/></f>",
      "<f v=\"0 1 2\"><n d=\"0 0 1\"/><n d=\"0 0 1\"/></f>",
      "<f v=\"0 1 2\"><n d=\"0 0 1\"/><n d=\"0 0 1\"/><n d=\"0 0 1\"/><n d=\"0 0 1\"/></f>",
      "<f v=\"0 1 2\"><n d=\"0 0\"/><n d=\"0 0 1\"/><n d=\"0 0 1\"/></f>", "<!-- --><f v=\"0 1 2\"/>",
      "x<f v=\"0 1 2\"/>", "<f fn=\"0 0 1\" v=\"0 1 2\"/>", "<f v=\"0 1 2\" fn=\"&lt;\"/>",
      "<f v=\"0 1 2\" fn=\"<\"/>", "<f v=\"-0 1 2\"/>", "<f v=\"0 1 99999999999\"/>",
      "<f v=\"0 1 2\" fn=\"\xe9\"/>", "<f v=\"0 1 2\"><n d=\"0 0 nan\"/></f>", "<f", "<facet/>");
  const std::string text = facet + "\n</facets>        ";
  const auto outline = outlined(text, 0, BodyKind::Facets);
  REQUIRE(outline);
  std::vector<Triangle> triangles;
  std::vector<Vector> normals;
  INFO(facet);
  CHECK_FALSE(scan_all(text, *outline, triangles, normals));
}

TEST_CASE("scan_points: plain points only, and no far ones", "[read]") {
  const auto taken = [](const std::string& body) {
    const std::string text = body + "</verts>  ";
    const auto outline = outlined(text, 0, BodyKind::Vertices);
    std::vector<Point> points(outline->items);
    std::string buffer;
    return scan_points(piece_text(TextSource(text), outline->pieces[0], buffer), BodyKind::Vertices, points);
  };
  CHECK(taken(""));
  CHECK(taken("\r\n\t <v p=\"1 -2.5 3e-014\"/>\n"));
  CHECK(taken("<v p=\".5 1. 1e15\"/>"));
  for (const char* body :
       {"<v p=\"1 2\"/>", "<v p=\"1 2 3 4\"/>", "<v p=\"1 2 1e16\"/>", "<v p=\"1 2 inf\"/>", "<v/>",
        "<v p=\"1 2 3\"></v>", "<v p=\"1 2 3\"/", "<vertex/>", "<v p=\"1,2,3\"/>", "<v p=\"+1 2 3\"/>"}) {
    INFO(body);
    CHECK_FALSE(taken(body));
  }
}

TEST_CASE("outline_body: a body without its closing tag is none", "[read]") {
  CHECK_FALSE(outlined("<v p=\"1 2 3\"/>", 0, BodyKind::Vertices));
  CHECK_FALSE(outlined(std::string(5000, ' ') + "</vert>", 0, BodyKind::Vertices));
  CHECK_FALSE(outlined("", 0, BodyKind::Polyline));
}

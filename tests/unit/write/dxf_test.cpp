#include <map>
#include <set>

#include "support/catch.hpp"
#include "unit/write/sample.hpp"
#include "write/dxf_file.hpp"

using namespace meshcontour;
using detail::dxf_name;

namespace {

using Tags = std::vector<std::pair<int, std::string>>;

Tags tags_of(const std::string& text) {
  const auto lines = lines_of(text);
  REQUIRE(lines.size() % 2 == 0);
  Tags tags;
  for (std::size_t i = 0; i < lines.size(); i += 2) tags.emplace_back(std::stoi(lines[i]), lines[i + 1]);
  return tags;
}

// The entities of model space: type first, then their tags.
std::vector<Tags> entities(const std::string& text) {
  std::vector<Tags> out;
  bool inside = false;
  for (const auto& tag : tags_of(text)) {
    if (tag == std::pair<int, std::string>{2, "ENTITIES"}) {
      inside = true;
    } else if (inside && tag == std::pair<int, std::string>{0, "ENDSEC"}) {
      return out;
    } else if (inside) {
      if (tag.first == 0) out.emplace_back();
      out.back().push_back(tag);
    }
  }
  return out;
}

std::vector<std::string> types(const std::vector<Tags>& entities) {
  std::vector<std::string> out;
  for (const Tags& tags : entities) out.push_back(tags[0].second);
  return out;
}

std::vector<double> reals(const Tags& tags, int code) {
  std::vector<double> out;
  for (const auto& [key, value] : tags) {
    if (key == code) out.push_back(std::stod(value));
  }
  return out;
}

using Types = std::vector<std::string>;

Sample square(double lift) {
  Sample s;
  s.model.metres_per_unit = 0.001;
  s.model.annotations = {{"a", {{0, 0, 0}, {4, 0, 0}, {4, 4, lift}, {0, 4, 0}}}};
  return s;
}

}  // namespace

TEST_CASE("dxf_name: no reserved character, no control, at most 255", "[write][dxf]") {
  CHECK(dxf_name("a<b>/\\c:d*|=`'\",;?^") == "a_b___c_d__________");
  CHECK(dxf_name("caf\xc3\xa9\n") == "caf\\U+00E9_");
  CHECK(dxf_name("\xf0\x9f\x98\x80") == "_");
  CHECK(dxf_name("") == "_");
  CHECK(dxf_name(" x ") == "_x_");
  CHECK(dxf_name(std::string(300, 'x')).size() == 255);
}

TEST_CASE("dxf: every curve as its own entity, a layer a patch, a group a loop", "[write][dxf]") {
  const std::string text = written(OutputFormat::Dxf, sample());
  const auto all = entities(text);
  CHECK(types(all) == Types{"LINE", "ARC", "ELLIPSE", "SPLINE", "CIRCLE", "ELLIPSE", "SPLINE", "LWPOLYLINE"});
  const auto tags = tags_of(text);
  const auto has = [&](int code, const std::string& value) {
    return std::ranges::count(tags, std::pair<int, std::string>{code, value});
  };
  CHECK(has(8, "shell_id7_patch_1") == 4);
  CHECK(has(8, "shell_id7_patch_2") == 4);
  CHECK(has(0, "LAYER") == 3);
  CHECK(has(0, "GROUP") == 1);
  CHECK(has(100, "AcDbGroup") == 1);
  CHECK(has(70, "4") >= 1);  // $INSUNITS: millimetre
  const Tags& arc = all[1];
  CHECK(reals(arc, 40) == std::vector<double>{5});
  CHECK(reals(arc, 50) == std::vector<double>{270});
  CHECK(reals(arc, 51) == std::vector<double>{90});
}

TEST_CASE("dxf: handles are unique", "[write][dxf]") {
  WriteOptions options;
  options.dxf = GENERATE(DxfContent::Curves, DxfContent::Polyline);
  std::set<std::string> handles;
  for (const auto& [code, value] : tags_of(written(OutputFormat::Dxf, sample(), options))) {
    if ((code != 5 && code != 105) || value == "FFFFFFFF") continue;
    CHECK(handles.insert(value).second);
  }
  CHECK(handles.size() > 30);
}

TEST_CASE("dxf: an arc that runs clockwise is turned, so that its normal is +z", "[write][dxf]") {
  Sample s;
  const CircularArc arc{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 1}, 1, std::numbers::pi / 2};
  s.model.curves = {named("", reversed(Curve(arc)))};
  const Tags found = entities(written(OutputFormat::Dxf, s)).at(0);
  CHECK(reals(found, 50) == std::vector<double>{0});
  CHECK(reals(found, 51) == std::vector<double>{90});
  CHECK(reals(found, 230) == std::vector<double>{1});
}

TEST_CASE("dxf polyline: lines and arcs of a flat loop become one LWPOLYLINE with bulges", "[write][dxf]") {
  Sample s = sample();
  auto& segments = s.contours[0].segments;
  segments.resize(2);
  segments.push_back({2, 0, LineSegment{{20, 10, 0}, {0, 0, 0}}});
  WriteOptions options;
  options.dxf = DxfContent::Polyline;
  std::vector<Diagnostic> notes;
  const auto all = entities(written(OutputFormat::Dxf, s, options, &notes));
  CHECK(types(all) == Types(5, "LWPOLYLINE"));
  CHECK(reals(all[0], 70) == std::vector<double>{1});
  CHECK(reals(all[0], 10) == std::vector<double>{0, 20, 20});
  CHECK(reals(all[0], 20) == std::vector<double>{0, 0, 10});
  REQUIRE(reals(all[0], 42).size() == 1);
  CHECK(reals(all[0], 42)[0] == Approx(1));
  const auto circle_bulges = reals(all[1], 42);
  REQUIRE(circle_bulges.size() == 2);
  CHECK(circle_bulges[0] == Approx(1));
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].count == 2);  // the ellipse and the spline
}

TEST_CASE("dxf: a polyline that is flat is an LWPOLYLINE, another a 3D POLYLINE", "[write][dxf]") {
  WriteOptions options;
  options.dxf = GENERATE(DxfContent::Curves, DxfContent::Polyline);
  std::vector<Diagnostic> notes;
  CHECK(types(entities(written(OutputFormat::Dxf, square(0), options, &notes))) == Types{"LWPOLYLINE"});
  CHECK(notes.empty());
  const auto lifted = entities(written(OutputFormat::Dxf, square(1), options, &notes));
  CHECK(types(lifted) == Types{"POLYLINE", "VERTEX", "VERTEX", "VERTEX", "VERTEX", "SEQEND"});
  CHECK(reals(lifted[3], 30) == std::vector<double>{1});
  CHECK(notes.size() == (options.dxf == DxfContent::Polyline ? 1 : 0));
}

TEST_CASE("dxf: units and times in the header", "[write][dxf]") {
  Sample s = sample();
  const auto header = [&](const std::string& name, int code) {
    const auto tags = tags_of(written(OutputFormat::Dxf, s));
    auto at = std::ranges::find(tags, std::pair<int, std::string>{9, name});
    while (at->first != code) ++at;
    return at->second;
  };
  CHECK(header("$INSUNITS", 70) == "4");
  s.model.metres_per_unit = 0.0254;
  CHECK(header("$INSUNITS", 70) == "1");
  CHECK(header("$MEASUREMENT", 70) == "0");
  s.model.metres_per_unit = 0;
  CHECK(header("$INSUNITS", 70) == "0");
  CHECK(header("$TDCREATE", 40) == "2451544.5");
}

TEST_CASE("dxf: names that become the same share a layer", "[write][dxf]") {
  Sample s;
  s.model.annotations = {{"a/b", {{0, 0, 0}, {1, 0, 0}}}, {"a:b", {{0, 0, 0}, {1, 0, 0}}}};
  const auto tags = tags_of(written(OutputFormat::Dxf, s));
  CHECK(std::ranges::count(tags, std::pair<int, std::string>{0, "LAYER"}) == 2);
}

#include "meshcontour/read.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "unit/read/webxml_text.hpp"

using namespace meshcontour;
using namespace webxml_text;
using Catch::Contains;

namespace {

const std::string kIdentity = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";

// The square, placed once for each xform.
std::string placed(std::initializer_list<std::string> xforms) {
  std::string children;
  for (const std::string& xform : xforms) children += "<child ref=\"id5\" xform=\"" + xform + "\"/>\n";
  return "<step-assembly root=\"id1\">\n<product id=\"id1\" name=\"T\" shape=\"id2\"/>\n<shape "
         "id=\"id2\">\n" +
         children + "</shape>\n<shape id=\"id5\" shell=\"id3\"/>\n" + shell(kPoints + kSquare) +
         "</step-assembly>\n";
}

}  // namespace

TEST_CASE("webxml: a square comes with everything that its file says", "[read]") {
  const Model model = read(square());
  CHECK(model.name == "T");
  CHECK(model.metres_per_unit == 0.001);
  CHECK(model.diagnostics.empty());
  REQUIRE(model.shells.size() == 1);
  const Shell& s = model.shells[0];
  CHECK(s.id == "id3");
  CHECK(s.color == Rgba{0x95, 0x95, 0x95, 0xff});
  CHECK(s.points == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  CHECK(s.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(s.corner_normals == std::vector<Vector>(6, Vector(0, 0, 1)));
  REQUIRE(s.patches.size() == 1);
  CHECK(s.patches[0].color == Rgba{0, 0xff, 0, 0xff});
  REQUIRE(model.instances.size() == 1);
  CHECK(model.instances[0].path == "id1/id2");
  CHECK(model.instances[0].placement.matrix().isIdentity(0));
}

TEST_CASE("webxml: the stud has the counts of its report", "[read]") {
  const Model model = read_model(MESHCONTOUR_DATA_DIR "/stud.xml");
  CHECK(model.name == "22X1_5_STUD");
  const Shell& s = model.shells.at(0);
  CHECK(s.id == "id34808");
  CHECK(s.points.size() == 238);
  CHECK(s.triangles.size() == 472);
  CHECK(s.patches.size() == 13);
  CHECK(s.patches.at(3).triangle_count == 68);
  CHECK(s.points.at(102) == Point(0, -15, 75));
  CHECK(s.corner_normals.size() == 3 * 472);
  CHECK(model.instances.at(0).path == "id34830/id34826");
  const double width = 15 * std::cos(std::numbers::pi / 34);  // no vertex lies on the x axis
  CHECK((bounding_box(model).min() - Point(-width, -15, 0)).norm() < 1e-12);
  CHECK((bounding_box(model).max() - Point(width, 15, 86)).norm() < 1e-12);
}

TEST_CASE("webxml: the assembly places shared, turned, mirrored and external parts", "[read]") {
  const Model model = read_model(MESHCONTOUR_DATA_DIR "/assembly/index.xml");
  CHECK(model.diagnostics.empty());
  REQUIRE(model.shells.size() == 2);
  CHECK(model.shells[0].id == "id32");
  CHECK(model.shells[0].points.size() == 48);
  CHECK(model.shells[0].triangles.size() == 92);
  CHECK(model.shells[0].color == Rgba{0xc0, 0x80, 0x20, 0xff});
  REQUIRE(model.instances.size() == 7);
  CHECK(model.instances[0].path == "id1/id2/id11");
  CHECK(model.instances[6].path == "id1/id2/id21/id31");
  std::size_t mirrored = 0;
  for (const Instance& instance : model.instances) mirrored += instance.placement.linear().determinant() < 0;
  CHECK(mirrored == 2);
  CHECK(model.instances[3].placement * Point(0, 0, 0) ==
        Point(17, 0, 4));  // turned by 90 degrees: y -5 becomes x +5
  CHECK(bounding_box(model).min() == Point(-22, -12, 0));
  CHECK(bounding_box(model).max() == Point(22, 40, 20));
  REQUIRE(model.annotations.size() == 2);
  CHECK(model.annotations[1].points.size() == 3);
}

TEST_CASE("webxml: a shell by itself is a model", "[read]") {
  const Model model = read_model(MESHCONTOUR_DATA_DIR "/assembly/shell_id32.xml");
  CHECK(model.shells.size() == 1);
  CHECK(model.instances.size() == 1);
  CHECK(model.name == "shell_id32");
  CHECK(model.diagnostics.empty());
}

TEST_CASE("webxml: xform is column major and multiplies from parent to child", "[read]") {
  const Model model = read(placed({"0 1 0 0 -1 0 0 0 0 0 1 0 5 0 0 1", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 9 1"}));
  REQUIRE(model.instances.size() == 2);
  CHECK(model.instances[0].placement * Point(1, 0, 0) == Point(5, 1, 0));
  CHECK(bounding_box(model).min() == Point(0, 0, 0));
  CHECK(bounding_box(model).max() == Point(5, 1, 9));
  CHECK(model.shells.size() == 1);
}

TEST_CASE("webxml: placements that are none are left out or refused", "[read][error]") {
  const auto with = [](const std::string& xform) { return read(placed({xform, kIdentity})); };
  const std::string left_out =
      GENERATE("1 0 0 5 0 1 0 6 0 0 1 7 0 0 0 1", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 2",
               "1e30 0 0 0 0 1e30 0 0 0 0 1e30 0 0 0 0 1", "1 0 0 0 0 1 0 0 0 0 0 0 0 0 0 1");
  const Model model = with(left_out);
  CHECK(model.instances.size() == 1);
  CHECK_THAT(texts(model.diagnostics), Contains("m.xml:4: child: warning: xform") && Contains("left out"));
  CHECK_THROWS_WITH(with("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0"),
                    "m.xml:4: child: xform needs 16 numbers, found 15");
  CHECK_THROWS_WITH(with("nan 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"), Contains("m.xml:4") && Contains("'nan'"));
}

TEST_CASE("webxml: several roots, shapes and shells are all placed", "[read]") {
  const Model model = read(
      "<step-assembly root=\"a b\"><product id=\"a\" name=\"A\" shape=\"s t\"/><product id=\"b\" name=\"B\" "
      "shape=\"u\"/>"
      "<shape id=\"s\" shell=\"x y\"/><shape id=\"t\" unit=\"in 0.025400\" shell=\"x\"/><shape id=\"u\" "
      "shell=\"y\"/>" +
      shell(kPoints + kSquare, "x") + shell(kPoints + kSquare, "y") + "</step-assembly>");
  std::string paths;
  for (const Instance& instance : model.instances)
    paths += instance.path + ":" + std::to_string(instance.shell) + " ";
  CHECK(paths == "a/s:0 a/s:1 a/t:0 b/u:1 ");
  CHECK(model.name == "A");
  CHECK(model.metres_per_unit == 0.0254);
}

TEST_CASE("webxml: annotations are placed with their shape", "[read]") {
  const Model model = read(
      "<step-assembly root=\"a\"><product id=\"a\" shape=\"s\"/><shape id=\"s\"><child ref=\"t\" "
      "xform=\"1 0 0 0 0 1 0 0 0 0 1 0 7 0 0 1\"/><child ref=\"t\" xform=\"" +
      kIdentity +
      "\"/></shape>"
      "<shape id=\"t\" annotation=\"n\"/><annotation id=\"n\"><polyline><p l=\"0 0 0\"/><p l=\"1 2 "
      "3\"/></polyline>"
      "<polyline><p l=\"1 1 1\"/></polyline><polyline/></annotation></step-assembly>");
  REQUIRE(model.annotations.size() == 2);
  CHECK(model.annotations[0].points == std::vector<Point>{{7, 0, 0}, {8, 2, 3}});
  CHECK(model.annotations[1].points == std::vector<Point>{{0, 0, 0}, {1, 2, 3}});
  CHECK(model.annotations[0].name == "n");
}

TEST_CASE("webxml: what nothing names takes the place of a missing root", "[read]") {
  const std::string text = square();
  CHECK(read(replaced(text, " root=\"id1\"", "")).instances.size() == 1);
  CHECK(read(replaced(text, "root=\"id1\"", "root=\"id7\"")).instances.size() == 1);
  CHECK(read("<step-assembly>" + shell(kPoints + kSquare) + "</step-assembly>").instances.size() == 1);
  CHECK_THAT(texts(read(replaced(text, " root=\"id1\"", "")).diagnostics), Contains("no root product"));
}

TEST_CASE("webxml: of two elements with one id the last counts", "[read]") {
  const std::string other = replaced(kPoints, "1 1 0", "1 2 0");
  const Model model = read(document(shell(kPoints + kSquare) + shell(other + kSquare)));
  CHECK(model.shells.size() == 1);
  CHECK(model.shells[0].points[2] == Point(1, 2, 0));
  CHECK_THAT(texts(model.diagnostics), Contains("id 'id3' is given to more than one element"));
}

TEST_CASE("webxml: empty patches keep their number", "[read]") {
  const Model model = read(document(shell(kPoints + "<facets/>\n<facets>\n</facets>\n" + kSquare)));
  REQUIRE(model.shells[0].patches.size() == 3);
  CHECK(model.shells[0].patches[2].first_triangle == 0);
  CHECK(model.shells[0].patches[2].triangle_count == 2);
}

TEST_CASE("webxml: degenerate and repeated triangles are left out with their normals", "[read]") {
  const std::string bad =
      "<f v=\"1 1 2\">\n<n d=\"1 0 0\"/>\n<n d=\"1 0 0\"/>\n<n d=\"1 0 0\"/>\n</f>\n<f v=\"1 2 0\"/>\n";
  const Model model =
      read(document(shell(kPoints + replaced(kSquare, "<f v=\"0 2 3\"", bad + "<f v=\"0 2 3\""))));
  CHECK(model.shells[0].triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(model.shells[0].corner_normals == std::vector<Vector>(6, Vector(0, 0, 1)));
  CHECK(model.diagnostics.size() == 2);
}

TEST_CASE("webxml: normals get length 1, or 0 where the file has none", "[read]") {
  const std::string facets =
      "<facets>\n<f v=\"0 1 2\">\n<n d=\"0 0 2\"/>\n<n d=\"0 0 0\"/>\n<n d=\"1e-200 0 0\"/>\n</f>\n<f v=\"0 "
      "2 3\"/>\n</facets>\n";
  const Model model = read(document(shell(kPoints + facets)));
  const auto& normals = model.shells[0].corner_normals;
  REQUIRE(normals.size() == 6);
  CHECK(normals[0] == Vector(0, 0, 1));
  CHECK(normals[1] == Vector(0, 0, 0));
  CHECK(normals[2] == Vector(1, 0, 0));
  CHECK(normals[3] == Vector(0, 0, 0));
  CHECK(read(document(shell(kPoints + "<facets><f v=\"0 1 2\" fn=\"0 0 1\"/></facets>")))
            .shells[0]
            .corner_normals.empty());
}

TEST_CASE("webxml: strict turns warnings into errors", "[read][error]") {
  const std::string text = replaced(square(), "00ff00", "#00ff0");
  CHECK(read(text).diagnostics.size() == 1);
  ReadOptions options;
  options.strict = true;
  CHECK_THROWS_WITH(read(text, options), Contains("m.xml:12: facets: color '#00ff0' is not rrggbb"));
  CHECK_NOTHROW(read(square(), options));
}

TEST_CASE("webxml: an assembly beyond the limits is refused before it is placed", "[read][error]") {
  std::string text = "<step-assembly root=\"p\"><product id=\"p\" shape=\"s0\"/>";
  for (int level = 0; level < 70; ++level) {
    const std::string child =
        "<child ref=\"s" + std::to_string(level + 1) + "\" xform=\"" + kIdentity + "\"/>";
    text += "<shape id=\"s" + std::to_string(level) + "\">" + child + child + "</shape>";
  }
  text += "<shape id=\"s70\" shell=\"id3\"/>" + shell(kPoints + kSquare) + "</step-assembly>";
  CHECK_THROWS_WITH(read(text), Contains("more than 2^64 instances, the limit is 1000000"));
  ReadOptions options;
  options.max_triangles = 1;
  CHECK_THROWS_WITH(read(square(), options), Contains("2 triangles, the limit is 1"));
  options.max_triangles = 3;
  CHECK_THROWS_WITH(read(placed({kIdentity, kIdentity}), options),
                    Contains("4 triangles over all instances"));
}

TEST_CASE("webxml: a long chain of shapes needs no recursion, and its path is shown by its ends", "[read]") {
  std::string text = "<step-assembly root=\"p\"><product id=\"p\" shape=\"s0\"/>";
  constexpr int kLevels = 30'000;
  for (int level = 0; level < kLevels; ++level) {
    text += "<shape id=\"s" + std::to_string(level) + "\"><child ref=\"s" + std::to_string(level + 1) +
            "\" xform=\"1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 1\"/></shape>";
  }
  text += "<shape id=\"s30000\" shell=\"id3\"/>" + shell(kPoints + kSquare) + "</step-assembly>";
  const Model model = read(text);
  REQUIRE(model.instances.size() == 1);
  CHECK(model.instances[0].placement.translation().x() == kLevels);
  CHECK_THAT(model.instances[0].path,
             Catch::StartsWith("p/s0/s1/") && Catch::EndsWith("/s30000") && Contains("/.../"));
}

TEST_CASE("webxml: shapes that contain one another are an error that names them", "[read][error]") {
  const auto cycle = [](const std::string& back) {
    return "<step-assembly root=\"p\">\n<product id=\"p\" shape=\"a\"/>\n<shape id=\"a\"><child ref=\"b\" "
           "xform=\"" +
           kIdentity + "\"/></shape>\n<shape id=\"b\"><child ref=\"" + back + "\" xform=\"" + kIdentity +
           "\"/></shape>\n</step-assembly>";
  };
  CHECK_THROWS_WITH(read(cycle("a")), "m.xml:3: shape: shapes contain one another: a > b > a");
  CHECK_THROWS_WITH(read(cycle("b")), "m.xml:4: shape: shapes contain one another: b > b");
}

TEST_CASE("webxml: files that a model in memory names are not looked for", "[read][error]") {
  const std::string stub = "<shell id=\"id3\" href=\"shell_id32.xml\"/>\n";
  CHECK_THROWS_WITH(read(document(stub)), Contains("m.xml:5: shell id3") && Contains("not read from a file"));
}

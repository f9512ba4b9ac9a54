#include <map>
#include <sstream>

#include "support/catch.hpp"
#include "unit/write/sample.hpp"

using namespace meshcontour;

namespace {

// What a reader that knows only `v`, `o` and `l` finds.
struct Polylines {
  std::vector<Point> points;
  std::map<std::string, std::vector<std::size_t>> lines;
};

Polylines read_polylines(const std::string& text) {
  Polylines out;
  std::string name;
  for (const std::string& line : lines_of(text)) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "o") words >> name;
    if (key == "v") {
      Point p;
      words >> p.x() >> p.y() >> p.z();
      out.points.push_back(p);
    }
    if (key == "l") {
      for (std::size_t i = 0; words >> i;) out.lines[name].push_back(i - 1);
    }
  }
  return out;
}

}  // namespace

TEST_CASE("obj: one closed polyline a loop, through the loop's vertices", "[write][obj]") {
  const Sample s = sample();
  const Polylines read = read_polylines(written(OutputFormat::Obj, s));
  REQUIRE(read.lines.size() == 5);
  CHECK(read.points.size() == 4 + 3 + 3);
  const auto& line = read.lines.at("shell_id7_patch_2_loop_4");
  REQUIRE(line.size() == 4);
  CHECK(line.front() == line.back());
  for (std::size_t i = 0; i < 3; ++i) CHECK(read.points[line[i]] == s.model.shells[0].points[7 + i]);
}

TEST_CASE("obj: an open chain stays open", "[write][obj]") {
  Sample s = sample();
  open_loop(s.boundaries[0].patches[0], 0);
  CHECK(read_polylines(written(OutputFormat::Obj, s)).lines.at("shell_id7_patch_1_loop_1").size() == 4);
}

TEST_CASE("obj: every instance is written, placed and with a name of its own", "[write][obj]") {
  Sample s = sample();
  const Eigen::Affine3d there = placement({100, 0, 0}, 1, {1, 2, 3}, -1);
  s.model.instances.push_back({0, there, "root/mirrored"});
  const Polylines read = read_polylines(written(OutputFormat::Obj, s));
  REQUIRE(read.lines.size() == 10);
  const auto& line = read.lines.at("shell_id7_patch_1_loop_1_instance_2");
  for (std::size_t i = 0; i < 4; ++i)
    CHECK(read.points[line[i]].isApprox(there * s.model.shells[0].points[i], 1e-14));
}

TEST_CASE("obj: names are one word", "[write][obj]") {
  Sample s = sample();
  s.model.shells[0].id = "a b\n#\\\x1b\xff";
  CHECK(
      read_polylines(written(OutputFormat::Obj, s)).lines.count("shell_a_b____\xef\xbf\xbd_patch_1_loop_1") ==
      1);
}

TEST_CASE("obj: edges shared by two patches are written once on request", "[write][obj]") {
  // A square of two triangles that are patches of their own: 6 chords, one of them shared.
  Sample s;
  Shell shell;
  shell.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  s.model.shells = {shell};
  s.model.instances = {{0, Eigen::Affine3d::Identity(), ""}, {0, placement({5, 0, 0}, 0, {0, 0, 1}), ""}};
  PatchBoundary first, second;
  first.loops = {{{0, 1, 2}, true}};
  second.loops = {{{0, 2, 3}, true}};
  s.boundaries = {{{first, second}}};
  WriteOptions options;
  options.edges = EdgeUse::Unique;
  const bool fitted = GENERATE(false, true);
  if (fitted) {
    const auto line = [&](Index a, Index b, Index edge) {
      return Segment{a, b, LineSegment{shell.points[a], shell.points[b]}, 0, edge, 1, false};
    };
    s.contours = {{0, 0, 0, true, {line(0, 1, 0), line(1, 2, 1), line(2, 0, 2)}},
                  {0, 1, 0, true, {line(0, 2, 2), line(2, 3, 3), line(3, 0, 4)}}};
    options.obj = ObjContent::Curves;
    const std::string text = written(OutputFormat::Obj, s, options);
    const auto is_curve = [](const std::string& l) { return l.starts_with("curv "); };
    const auto all = lines_of(text);
    CHECK(std::ranges::count_if(all, is_curve) == 10);
  } else {
    const Polylines read = read_polylines(written(OutputFormat::Obj, s, options));
    REQUIRE(read.lines.size() == 4);
    CHECK(read.lines.at("shell__patch_1_loop_1_instance_1").size() == 4);
    const auto& rest = read.lines.at("shell__patch_2_loop_1_instance_2");
    REQUIRE(rest.size() == 3);
    CHECK(read.points[rest[0]] == Point(6, 1, 0));
    CHECK(read.points[rest[2]] == Point(5, 0, 0));
  }
}

TEST_CASE("obj curves: what the file says is the curve", "[write][obj]") {
  Sample s = sample();
  s.model.curves = {named("rail", rational_spline())};
  WriteOptions options;
  options.obj = ObjContent::Curves;
  std::vector<Curve> expected;
  for (const Contour& contour : s.contours) {
    if (contour.fallback) continue;
    for (const Segment& segment : contour.segments) expected.push_back(segment.curve);
  }
  std::vector<Point> points;
  std::vector<double> weights;
  std::vector<BSplineCurve> curves;
  for (const std::string& line : lines_of(written(OutputFormat::Obj, s, options))) {
    std::istringstream words(line);
    std::string key, word;
    words >> key;
    if (key == "v") {
      Point p;
      double w = 1;
      words >> p.x() >> p.y() >> p.z();
      words >> w;
      points.push_back(p);
      weights.push_back(words ? w : 1);
    } else if (key == "cstype") {
      curves.emplace_back();
    } else if (key == "deg") {
      words >> curves.back().degree;
    } else if (key == "curv") {
      double range = 0;
      words >> range >> range;
      for (std::size_t i = 0; words >> i;) {
        curves.back().control_points.push_back(points.at(i - 1));
        curves.back().weights.push_back(weights.at(i - 1));
      }
    } else if (key == "parm") {
      words >> word;
      for (double knot = 0; words >> knot;) curves.back().knots.push_back(knot);
    }
  }
  REQUIRE(curves.size() == 4 + 3 + 1 + 1);
  CHECK(curves[7].control_points.size() == 4);  // the polygon
  CHECK(curves[7].degree == 1);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto& knots = curves[i].knots;
    const auto order = static_cast<std::size_t>(curves[i].degree) + 1;
    CHECK(knots.size() == curves[i].control_points.size() + order);
    CHECK(knots.front() == knots[order - 1]);
    CHECK(knots.back() == knots[knots.size() - order]);
    for (const double u : {0.0, 0.5, 1.0}) {
      CHECK((evaluate(Curve(curves[i]), u) - evaluate(expected[i], u)).norm() < 1e-12);
    }
  }
}

TEST_CASE("obj: annotations and curves of the model become polylines", "[write][obj]") {
  Sample s;
  s.model.annotations = {{"note one", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}}, {"", {{0, 0, 0}}}};
  s.model.curves = {named("rail", periodic_spline())};
  const Polylines read = read_polylines(written(OutputFormat::Obj, s));
  REQUIRE(read.lines.size() == 2);
  CHECK(read.lines.at("annotation_note_one") == std::vector<std::size_t>{0, 1, 2});
  const auto& rail = read.lines.at("curve_rail");
  CHECK(rail.front() == rail.back());
  CHECK(rail.size() > 40);
}

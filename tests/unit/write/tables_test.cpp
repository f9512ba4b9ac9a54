#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "unit/write/sample.hpp"

using namespace meshcontour;
using nlohmann::json;

namespace {

Point point(const json& j) {
  return Point(j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>());
}

// A segment as an independent reader of the contract would build it.
Curve curve_from(const json& s) {
  const std::string type = s.at("type");
  const Point start = point(s.at("start")), end = point(s.at("end"));
  if (type == "line") return LineSegment{start, end};
  if (type == "arc" || type == "circle") {
    return CircularArc{start, end, point(s.at("center")), point(s.at("axis")), s.at("radius"), s.at("angle")};
  }
  if (type == "ellipse") {
    return EllipticalArc{
        start,         end,          point(s.at("center")), point(s.at("axis")), point(s.at("major")),
        s.at("ratio"), s.at("angle")};
  }
  BSplineCurve curve;
  curve.degree = s.at("degree");
  curve.knots = s.at("knots").get<std::vector<double>>();
  for (const json& p : s.at("control_points")) curve.control_points.push_back(point(p));
  if (s.contains("weights")) curve.weights = s.at("weights").get<std::vector<double>>();
  curve.periodic = s.at("periodic");
  return curve;
}

}  // namespace

TEST_CASE("loops.csv: a row a vertex, numbers that read back exactly", "[write][csv]") {
  Sample s = sample();
  s.model.shells[0].points[1] = {0.1, 1e-300, -123456789.123456789};
  open_loop(s.boundaries[0].patches[0], 0);
  const auto rows = lines_of(written(OutputFormat::Csv, s));
  REQUIRE(rows.size() == 1 + 4 + 3 + 3);
  CHECK(rows[0] == "shell,patch,loop,closed,index,vertex,x,y,z");
  CHECK(rows[2] == "id7,1,1,0,1,1,0.1,1e-300,-123456789.12345679");
  CHECK(rows[8] == "id7,2,4,1,0,7,0,0,50");
}

TEST_CASE("curves.csv: a row a segment", "[write][csv]") {
  WriteOptions options;
  options.csv = CsvContent::Curves;
  const auto rows = lines_of(written(OutputFormat::Csv, sample(), options));
  REQUIRE(rows.size() == 1 + 4 + 3 + 3);
  CHECK(rows[0] ==
        "shell,patch,loop,segment,type,degree,control_points,start_x,start_y,start_z,end_x,end_y,end_z,"
        "radius,deviation");
  CHECK(rows[1] == "id7,1,1,1,line,,,0,0,0,20,0,0,,0");
  CHECK(rows[2] == "id7,1,1,2,arc,,,20,0,0,20,10,0,5,1e-06");
  CHECK(rows[4] == "id7,1,1,4,bspline,3,5,16,12,0,0,0,0,,0");
  CHECK(rows[5] == "id7,2,1,1,circle,,,7,0,10,7,0,10,7,0");
}

TEST_CASE("csv: names cannot break a row, run as a formula or command a terminal", "[write][csv]") {
  Sample s = sample();
  const auto first_cell = [&](const std::string& id) {
    s.model.shells[0].id = id;
    const std::string row = lines_of(written(OutputFormat::Csv, s))[1];
    return row.substr(0, row.rfind(",1,1,1,0,0,0,0,0"));
  };
  CHECK(first_cell("plain") == "plain");
  CHECK(first_cell("a,b") == "\"a,b\"");
  CHECK(first_cell("say \"x\"") == "\"say \"\"x\"\"\"");
  CHECK(first_cell("=1+1") == "\"'=1+1\"");
  CHECK(first_cell("two\nlines") == "two\\x0alines");
  CHECK(first_cell("\x1b[31m") == "\\x1b[31m");
  CHECK(first_cell("\xff") == "\xef\xbf\xbd");
}

TEST_CASE("json: every segment reads back to the last bit", "[write][json]") {
  Sample s = sample();
  s.contours[1].segments[0].curve = rational_spline();
  const json doc = json::parse(written(OutputFormat::Json, s));
  for (const Contour& contour : s.contours) {
    const json& loop = doc["patches"][contour.patch]["loops"][contour.loop];
    REQUIRE(loop["segments"].size() == contour.segments.size());
    for (std::size_t i = 0; i < contour.segments.size(); ++i) {
      const Segment& segment = contour.segments[i];
      const json& found = loop["segments"][i];
      CHECK(found["from"] == segment.from);
      CHECK(found["to"] == segment.to);
      const Curve curve = curve_from(found);
      REQUIRE(curve.index() == segment.curve.index());
      for (const double u : {0.0, 0.3, 1.0}) CHECK(evaluate(curve, u) == evaluate(segment.curve, u));
    }
  }
}

TEST_CASE("json: counts, instances, loops and diagnostics", "[write][json]") {
  Sample s = sample();
  s.model.name = "a \"quoted\" \\ name\n\x01\xff";
  s.model.instances.push_back({0, placement({1, 2, 3}, 0.5, {0, 0, 1}), "root/child"});
  const std::vector<Diagnostic> diagnostics = {
      {Diagnostic::Severity::Warning, "left out", {"a.xml", 3, 0, "f"}, 2}};
  const std::vector<StageTime> timings = {{"read", 0, 1.5, 1.25, 10}};
  Result result = s.result();
  result.diagnostics = diagnostics;
  result.timings = timings;
  StringSink sink;
  std::vector<Diagnostic> notes;
  write_output(OutputFormat::Json, result, {}, sink, notes);
  const json doc = json::parse(sink.text);
  CHECK(doc["model"]["name"] == "a \"quoted\" \\ name\n\x01\xef\xbf\xbd");
  CHECK(doc["model"]["triangles"] == 2);
  CHECK(doc["model"]["vertices"] == 10);
  CHECK(doc["boundary"] == json({{"edges", 7}, {"vertices", 7}, {"loops", 5}, {"extractor", "sorted"}}));
  REQUIRE(doc["instances"].size() == 2);
  CHECK(doc["instances"][1]["path"] == "root/child");
  CHECK(doc["instances"][1]["placement"][12] == 1.0);
  CHECK(doc["instances"][1]["placement"][1] == Approx(std::sin(0.5)));
  const json& loop = doc["patches"][1]["loops"][3];
  CHECK(loop["loop"] == 4);
  CHECK(loop["vertices"] == 3);
  CHECK(loop["closed"] == true);
  CHECK(loop["length"].get<double>() == Approx(1 + std::sqrt(2) + std::sqrt(3)));
  CHECK(doc["diagnostics"][0]["message"] == "left out");
  CHECK(doc["diagnostics"][0]["count"] == 2);
  CHECK(doc["timings"][0] == json({{"stage", "read"}, {"wall_ms", 1.5}, {"cpu_ms", 1.25}, {"items", 10}}));
}

TEST_CASE("json: a number that is not finite is null, a model without anything is valid", "[write][json]") {
  Sample s = sample();
  s.contours[0].deviation = std::numeric_limits<double>::infinity();
  CHECK(json::parse(written(OutputFormat::Json, s))["patches"][0]["loops"][0]["deviation"].is_null());
  const json doc = json::parse(written(OutputFormat::Json, Sample()));
  CHECK(doc["patches"].empty());
  CHECK(doc["model"]["metres_per_unit"].is_null());
}

TEST_CASE("json: annotations and curves of the model are listed", "[write][json]") {
  Sample s = sample();
  s.model.annotations = {{"a", {{1, 2, 3}, {4, 5, 6}}}, {"b", {}}};
  s.model.curves = {named("rail", periodic_spline()), named("", LineSegment{{0, 0, 0}, {1, 0, 0}})};
  const json doc = json::parse(written(OutputFormat::Json, s));
  CHECK(doc["annotations"] ==
        json::parse(R"([{"name":"a","points":[[1,2,3],[4,5,6]]},{"name":"b","points":[]}])"));
  CHECK(doc["curves"][0]["name"] == "rail");
  CHECK(doc["curves"][0]["periodic"] == true);
  CHECK(doc["curves"][1]["type"] == "line");
}

TEST_CASE("output_format: by name or extension, in any case", "[write]") {
  CHECK(output_format("csv") == OutputFormat::Csv);
  CHECK(output_format(".JSON") == OutputFormat::Json);
  CHECK(output_format("Png") == OutputFormat::Png);
  CHECK_FALSE(output_format("cs"));
  CHECK_FALSE(output_format(""));
  for (const std::string_view name : output_format_names()) CHECK(output_format(name));
}

TEST_CASE("source_date_epoch: whole seconds or a refusal", "[write][error]") {
  const auto with = [](const char* text) {
    setenv("SOURCE_DATE_EPOCH", text, 1);
    struct Unset {
      ~Unset() { unsetenv("SOURCE_DATE_EPOCH"); }
    } unset;
    return source_date_epoch();
  };
  CHECK(with("86400") == 86400);
  CHECK_FALSE(with(""));
  CHECK_FALSE(source_date_epoch());
  for (const char* wrong : {"x", "1 ", "-1", "1e3", "999999999999"}) CHECK_THROWS_AS(with(wrong), Error);
}

#include <map>
#include <regex>
#include <set>

#include "support/catch.hpp"
#include "unit/write/sample.hpp"
#include "write/step_text.hpp"

using namespace meshcontour;
using detail::step_string;

namespace {

// The instances of a file by number; every line of the data section is one.
std::map<int, std::string> entities(const std::string& text) {
  std::map<int, std::string> out;
  for (const std::string& line : lines_of(text)) {
    std::smatch found;
    if (std::regex_match(line, found, std::regex("#([0-9]+)=(.*);"))) out[std::stoi(found[1])] = found[2];
  }
  return out;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("step_string: quotes, backslashes and everything beyond ASCII", "[write][step]") {
  CHECK(step_string("plain") == "'plain'");
  CHECK(step_string("it's \\ ok") == "'it''s \\\\ ok'");
  CHECK(step_string("\xc3\xa9\n") == "'\\X2\\00E9\\X0\\\\X2\\000A\\X0\\'");
  CHECK(step_string("\xf0\x9f\x98\x80") == "'\\X4\\0001F600\\X0\\'");
  CHECK(step_string("\xff") == "'\\X2\\FFFD\\X0\\'");
}

TEST_CASE("StepReal: always with a point, and E", "[write][step]") {
  const auto step_real = [](double value) { return fmt::format("{}", detail::StepReal{value}); };
  CHECK(step_real(0) == "0.");
  CHECK(step_real(-20) == "-20.");
  CHECK(step_real(0.1) == "0.1");
  CHECK(step_real(1e-5) == "1.E-05");
  CHECK(step_real(1.5e300) == "1.5E+300");
}

TEST_CASE("step: every reference names an earlier entity, every curve has its kind", "[write][step]") {
  WriteOptions options;
  options.step = GENERATE(StepSchema::Ap242, StepSchema::Ap214);
  Sample s = sample();
  s.model.curves = {named("rail", rational_spline())};
  const std::string text = written(OutputFormat::Step, s, options);
  const auto all = entities(text);
  const std::regex reference("#([0-9]+)");
  for (const auto& [number, entity] : all) {
    for (std::sregex_iterator at(entity.begin(), entity.end(), reference), end; at != end; ++at) {
      CHECK(std::stoi((*at)[1]) < number);
    }
  }
  CHECK(count(text, "GEOMETRIC_CURVE_SET('shell_id7_patch_") == 2);
  CHECK(count(text, "COMPOSITE_CURVE('shell_id7_patch_1_loop_1'") == 1);
  CHECK(count(text, "COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.") == 4);
  CHECK(count(text, "=TRIMMED_CURVE(") == 3);
  CHECK(count(text, "=CIRCLE(") == 2);
  CHECK(count(text, "=ELLIPSE(") == 2);
  CHECK(count(text, "=B_SPLINE_CURVE_WITH_KNOTS(") == 2);
  CHECK(count(text, "RATIONAL_B_SPLINE_CURVE((1.,") == 1);
  CHECK(count(text, "=POLYLINE('shell_id7_patch_2_loop_4'") == 1);
  CHECK(count(text, "AUTOMOTIVE_DESIGN") == (options.step == StepSchema::Ap214 ? 1 : 0));
}

TEST_CASE("step: an open chain ends discontinuous", "[write][step]") {
  Sample s = sample();
  s.contours[0].closed = false;
  open_loop(s.boundaries[0].patches[0], 0);
  const std::string text = written(OutputFormat::Step, s);
  CHECK(count(text, "COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.") == 3);
  CHECK(count(text, "COMPOSITE_CURVE_SEGMENT(.DISCONTINUOUS.") == 1);
}

TEST_CASE("step: units by name or by factor, unknown ones with a note", "[write][step]") {
  Sample s = sample();
  std::vector<Diagnostic> notes;
  const auto text = [&](double metres) {
    s.model.metres_per_unit = metres;
    return written(OutputFormat::Step, s, {}, &notes);
  };
  CHECK(count(text(0.001), "LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.)") == 1);
  CHECK(count(text(1), "LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.)") == 1);
  CHECK(count(text(0.0254), "CONVERSION_BASED_UNIT('INCH'") == 1);
  CHECK(count(text(0.0254), "LENGTH_MEASURE(0.0254)") == 1);
  CHECK(count(text(0.5), "CONVERSION_BASED_UNIT('UNIT'") == 1);
  CHECK(notes.empty());
  CHECK(count(text(0), "SI_UNIT(.MILLI.,.METRE.)") == 1);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].text() == "note: STEP: the model does not tell its unit, written as millimetre");
}

TEST_CASE("step: the time is what was asked for, nothing else changes from run to run", "[write][step]") {
  const Sample s = sample();
  WriteOptions options;
  CHECK(count(written(OutputFormat::Step, s, options), "'2000-01-01T00:00:00'") == 1);
  options.timestamp = 1'700'000'000;
  CHECK(count(written(OutputFormat::Step, s, options), "'2023-11-14T22:13:20'") == 1);
  CHECK(written(OutputFormat::Step, s, options) == written(OutputFormat::Step, s, options));
}

TEST_CASE("step: a model without curves, and one with points repeated", "[write][step]") {
  const std::string empty = written(OutputFormat::Step, Sample());
  CHECK(count(empty, "=SHAPE_REPRESENTATION('contours'") == 1);
  CHECK(count(empty, "GEOMETRIC_CURVE_SET") == 0);
  Sample s;
  s.model.annotations = {{"a", {{1, 1, 1}, {1, 1, 1}}}, {"b", {{1, 1, 1}, {1, 1, 1}, {2, 1, 1}}}};
  s.model.curves = {named("c", LineSegment{{1, 1, 1}, {1, 1, 1}})};
  const std::string text = written(OutputFormat::Step, s);
  CHECK(count(text, "=POLYLINE(") == 1);
  CHECK(count(text, "=LINE(") == 0);
}

#include <tinyxml2.h>

#include <regex>
#include <sstream>

#include "support/catch.hpp"
#include "unit/write/sample.hpp"

using namespace meshcontour;

namespace {

struct Picture {
  explicit Picture(const std::string& text) {
    REQUIRE(document.Parse(text.c_str(), text.size()) == tinyxml2::XML_SUCCESS);
    root = document.FirstChildElement("svg");
    REQUIRE(root != nullptr);
    std::istringstream box(root->Attribute("viewBox"));
    box >> x >> y >> width >> height;
    for (auto* group = root->FirstChildElement("g")->FirstChildElement("g"); group != nullptr;
         group = group->NextSiblingElement("g")) {
      for (auto* path = group->FirstChildElement("path"); path != nullptr;
           path = path->NextSiblingElement("path")) {
        paths.emplace_back(path->Attribute("id"), path->Attribute("d"));
      }
    }
  }

  tinyxml2::XMLDocument document;
  tinyxml2::XMLElement* root = nullptr;
  double x = 0, y = 0, width = 0, height = 0;
  std::vector<std::pair<std::string, std::string>> paths;
};

std::string commands(const std::string& path) {
  return std::regex_replace(path, std::regex("[^A-Z]"), "");
}

std::string written_from(const Sample& s, View view) {
  WriteOptions options;
  options.view = view;
  return written(OutputFormat::Svg, s, options);
}

}  // namespace

TEST_CASE("svg: one path a loop, exact commands, seen from the top", "[write][svg]") {
  const Picture picture(written_from(sample(), View::Top));
  REQUIRE(picture.paths.size() == 5);
  CHECK(picture.paths[0].first == "shell_id7_patch_1_loop_1");
  CHECK(commands(picture.paths[0].second) == "MLAAACCZ");
  CHECK(picture.paths[0].second.starts_with("M0 0L20 0A5 5 "));
  CHECK(commands(picture.paths[1].second) == "MAAAZ");
  CHECK(commands(picture.paths[2].second) == "MAAAZ");
  CHECK(commands(picture.paths[3].second) == "MCCCCCZ");
  CHECK(picture.paths[4].second == "M0 0L1 0L1 -1Z");
}

TEST_CASE("svg: the page holds the drawing and nothing else", "[write][svg]") {
  Sample s;
  s.model.metres_per_unit = 0.0254;
  // A shallow arc: its circle is far larger than what is drawn.
  const double angle = 0.02, r = 1000;
  s.model.curves = {named(
      "",
      CircularArc{{r, 0, 0}, {r * std::cos(angle), r * std::sin(angle), 0}, {0, 0, 0}, {0, 0, 1}, r, angle})};
  const Picture picture(written_from(s, View::Top));
  const double tall = r * std::sin(angle), wide = r * (1 - std::cos(angle)),
               margin = 0.03 * std::hypot(tall, wide);
  CHECK(picture.width == Approx(wide + 2 * margin));
  CHECK(picture.height == Approx(tall + 2 * margin));
  CHECK(picture.y == Approx(-tall - margin));
  CHECK(std::stod(picture.root->Attribute("width")) == Approx(25.4 * (wide + 2 * margin)));
  CHECK(std::string(picture.root->Attribute("width")).ends_with("mm"));
}

TEST_CASE("svg: a circle seen edge-on is a line, tilted an ellipse", "[write][svg]") {
  Sample s;
  const CircularArc circle{{7, 0, 0}, {7, 0, 0}, {0, 0, 0}, {0, 0, 1}, 7, 2 * std::numbers::pi};
  s.model.curves = {named("", circle)};
  const Picture front(written_from(s, View::Front));
  CHECK(commands(front.paths[0].second).find('A') == std::string::npos);
  CHECK(front.width == Approx(14 + 0.06 * 14));
  const Picture iso(written_from(s, View::Iso));
  const std::string path = iso.paths[0].second;
  std::istringstream arc(path.substr(path.find('A') + 1));
  double major = 0, minor = 0;
  arc >> major >> minor;
  CHECK(major == Approx(7));
  CHECK(minor == Approx(7 / std::sqrt(3)));
}

TEST_CASE("svg: names are escaped, the result is always XML", "[write][svg]") {
  Sample s = sample();
  s.model.name = "<script>\x01&\"";
  s.model.shells[0].id = "\"/><script x='";
  const Picture picture(written_from(s, View::Top));
  CHECK(picture.paths[0].first == "shell_\"/><script_x='_patch_1_loop_1");
  CHECK(std::string(picture.root->FirstChildElement("title")->GetText()) == "<script>\xef\xbf\xbd&\"");
  CHECK(Picture(written(OutputFormat::Svg, Sample())).paths.empty());
}

TEST_CASE("svg: a rational curve follows its arc", "[write][svg]") {
  Sample s;
  s.model.curves = {named("", rational_spline())};
  const std::string path = Picture(written_from(s, View::Top)).paths[0].second;
  CHECK(commands(path) == "M" + std::string(16, 'C'));
  const std::regex number("-?[0-9.]+");
  std::vector<double> values;
  for (std::sregex_iterator at(path.begin(), path.end(), number), end; at != end; ++at)
    values.push_back(std::stod(at->str()));
  for (std::size_t i = 0; i + 1 < values.size(); i += 6)
    CHECK(std::hypot(values[i], values[i + 1]) == Approx(3).epsilon(1e-8));
}

// Every file of data/ against the values in expected.json, which another program computed.

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "meshcontour/boundary.hpp"
#include "read/swp.hpp"
#include "support/catch.hpp"
#include "survey.hpp"

using namespace sweeps;
using nlohmann::json;

namespace {

const json& expected_files() {
  static const json files = [] {
    std::ifstream in(data_file("expected.json"));
    return json::parse(in).at("files");
  }();
  return files;
}

// The given digits of a value that was printed with ten.
void check_value(double found, const json& expected) {
  if (expected.is_null()) return;
  const double value = expected.get<double>();
  CHECK(found == Approx(value).epsilon(1e-9));
}

void check_surface(const Shell& shell, const json& expected) {
  INFO(expected.at("name"));
  CHECK(shell.id == expected.at("name"));
  const Survey found = survey(shell);
  CHECK(found.vertices == expected.at("vertices"));
  CHECK(found.edges == expected.at("edges"));
  CHECK(found.faces == expected.at("faces"));
  CHECK(found.euler() == expected.at("euler"));
  CHECK(found.components == expected.at("components"));
  CHECK(found.boundary_loops == expected.at("boundary_loops"));
  CHECK(found.closed() == expected.at("closed"));
  CHECK(found.bad_edges == 0);
  CHECK(found.unused_vertices == 0);
  CHECK(found.disagreeing == 0);
  CHECK(found.least_volume > 0);
  CHECK(found.least_distance > 1e-9);
  CHECK(found.least_face > 1e-14);
  check_value(found.area, expected.at("area"));
  check_value(found.volume, expected.at("volume"));
}

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

Vector vector_of(const json& numbers) {
  return Vector(numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>());
}

double largest_turn(const std::vector<CurveFrame>& frames) {
  double largest = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const Vector &a = frames[i - 1].normal, &b = frames[i].normal;
    largest = std::max(largest, std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  return largest;
}

void check_frames(const SweepCurve& curve, const FramedCurve& framed, const json& expected) {
  CHECK((framed.frames.front().tangent - vector_of(expected.at("first_T"))).norm() < 1e-9);
  CHECK((framed.frames.front().normal - vector_of(expected.at("first_N"))).norm() < 1e-9);
  CHECK((framed.frames.front().binormal - vector_of(expected.at("first_B"))).norm() < 1e-9);
  CHECK(degrees(framed.closing_angle) == Approx(expected.at("closing_angle_deg_rmf")).margin(1e-5));
  CHECK(degrees(largest_turn(framed.frames)) ==
        Approx(expected.at("max_consecutive_N_angle_deg")).margin(0.01));
  SweepOptions options;
  options.frames = FrameMethod::Projection;
  CHECK(degrees(frame_curve(curve, options).closing_angle) ==
        Approx(expected.at("closing_angle_deg_pdf")).margin(1e-5));
}

void check_curve(const SweepCurve& curve, const json& expected) {
  INFO(expected.at("name"));
  const FramedCurve framed = frame_curve(curve);
  CHECK(framed.frames.size() == expected.at("points"));
  CHECK(framed.closed == expected.at("closed"));
  CHECK(framed.smooth == expected.at("smooth_closed"));
  CHECK((framed.frames.front().position - vector_of(expected.at("first"))).norm() < 1e-9);
  CHECK((framed.frames.back().position - vector_of(expected.at("last"))).norm() < 1e-9);
  CHECK(framed.length == Approx(expected.at("length")).epsilon(1e-8));
  if (curve.radius > 0 || curve.kind != SweepCurve::Kind::Circle) {
    CHECK(length(to_curve(curve)) == Approx(expected.at("length")).epsilon(1e-9));
  }
  if (expected.contains("first_N")) check_frames(curve, framed, expected);
}

}  // namespace

TEST_CASE("sweeps: points, lengths and frames of every curve are those of another program", "[sweep]") {
  std::size_t curves = 0;
  for (const auto& [name, file] : expected_files().items()) {
    if (!file.at("parse").at("ok")) continue;
    INFO(name);
    const SweepScene scene = detail::parse_swp(data_bytes(name), name);
    REQUIRE(scene.curves.size() == file.at("curves").size());
    for (std::size_t i = 0; i < scene.curves.size(); ++i, ++curves) {
      check_curve(scene.curves[i], file.at("curves")[i]);
    }
  }
  CHECK(curves == 24);
}

TEST_CASE("sweeps: every surface is what another program makes of it", "[sweep]") {
  std::size_t surfaces = 0;
  for (const auto& [name, file] : expected_files().items()) {
    if (!file.at("parse").at("ok")) continue;
    INFO(name);
    const Model model = read_model(data_file(name));
    REQUIRE(model.shells.size() == file.at("surfaces").size());
    REQUIRE(model.curves.size() + model.shells.size() <= file.at("parse").at("objects"));
    for (std::size_t i = 0; i < model.shells.size(); ++i) {
      check_surface(model.shells[i], file.at("surfaces")[i]);
      ++surfaces;
    }
  }
  CHECK(surfaces == 14);
}

TEST_CASE("sweeps: bad files are refused with code, line and column", "[sweep][error]") {
  std::size_t refused = 0;
  for (const auto& [name, file] : expected_files().items()) {
    const json& parse = file.at("parse");
    if (parse.at("ok")) continue;
    INFO(name);
    ++refused;
    try {
      read_model(data_file(name));
      FAIL("was read");
    } catch (const Error& error) {
      INFO(error.what());
      CHECK(error.code() == ErrorCode::BadData);
      CHECK(error.spot().line == parse.at("line"));
      CHECK(error.spot().column == parse.at("col"));
      const std::string message = error.what(), code = parse.at("code");
      CHECK(message.find("expected ") != std::string::npos);
      CHECK(message.find("found ") != std::string::npos);
      CHECK(message.ends_with("[" + code + "]"));
    }
  }
  CHECK(refused == 24);
}

TEST_CASE("sweeps: both extractors find the open ends and nothing else", "[sweep]") {
  for (const auto& [name, file] : expected_files().items()) {
    if (!file.at("parse").at("ok") || file.at("surfaces").empty()) continue;
    INFO(name);
    Model model = read_model(data_file(name));
    for (Shell& shell : model.shells) shell.patches = {{"all", {}, 0, shell.triangles.size()}};
    for (const Extractor extractor : {Extractor::Sorted, Extractor::Halfedge}) {
      std::vector<Diagnostic> diagnostics;
      BoundaryOptions options;
      options.extractor = extractor;
      const auto boundaries = extract_boundaries(model, options, diagnostics);
      CHECK(diagnostics.empty());
      for (std::size_t i = 0; i < boundaries.size(); ++i) {
        CHECK(boundaries[i].patches.at(0).loops.size() == file.at("surfaces")[i].at("boundary_loops"));
      }
    }
  }
}

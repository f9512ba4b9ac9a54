// Corners, caps, patches, poles and normals.

#include <cmath>
#include <numbers>

#include "meshcontour/boundary.hpp"
#include "read/swp.hpp"
#include "support/catch.hpp"
#include "survey.hpp"

using namespace sweeps;

namespace {

SweepOptions with_caps() {
  SweepOptions options;
  options.caps = true;
  return options;
}

// The angle between a corner normal and the mean normal of the faces around its vertex, within one patch.
double largest_normal_error(const Shell& shell) {
  std::vector<Vector> sums(shell.points.size(), Vector::Zero());
  for (const Triangle& t : shell.triangles) {
    const Vector area =
        (shell.points[t[1]] - shell.points[t[0]]).cross(shell.points[t[2]] - shell.points[t[0]]);
    for (const Index v : t) sums[v] += area;
  }
  double largest = 0;
  for (std::size_t i = 0; i < shell.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector &normal = shell.corner_normals[3 * i + k], &sum = sums[shell.triangles[i][k]];
      largest = std::max(largest, std::atan2(normal.cross(sum).norm(), normal.dot(sum)));
    }
  }
  return largest;
}

std::vector<std::string> patch_names(const Shell& shell) {
  std::vector<std::string> names;
  for (const Patch& patch : shell.patches) names.push_back(patch.name);
  return names;
}

// A prism of 2 x 0.5 around a path of four straight lines that turn by 90 degrees.
const std::string kFrame =
    "bez2 p 2 13 [-1 -0.25][0 -0.25][0.5 -0.25][1 -0.25] [1 0][1 0][1 0.25] [0 0.25][0 0.25][-1 0.25] "
    "[-1 0][-1 0][-1 -0.25] "
    "bez3 s 2 16 [0 -4 1][1 -4 1][2 -4 1][4 -4 1] [4 0 1][4 0 1][4 4 1] [0 4 1][0 4 1][-4 4 1] "
    "[-4 0 1][-4 0 1][-4 -4 1] [-3 -4 1][-1 -4 1][0 -4 1] gcyl frame p s";

}  // namespace

TEST_CASE("sweep: poles are single vertices with the axis as normal", "[sweep]") {
  const std::string name = GENERATE("sphere.swp", "sphere_right.swp");
  const Shell shell = read_model(data_file(name)).shells.at(0);
  std::size_t poles = 0;
  for (std::size_t i = 0; i < shell.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Point& p = shell.points[shell.triangles[i][k]];
      if (p.x() != 0 || p.z() != 0) continue;
      ++poles;
      REQUIRE(shell.corner_normals[3 * i + k] == Vector(0, p.y() > 0 ? 1 : -1, 0));
    }
  }
  CHECK(poles == 2 * 64);
}

TEST_CASE("sweep: the normals of a sphere are radial", "[sweep]") {
  const Shell shell = read_model(data_file("sphere_right.swp")).shells.at(0);
  for (std::size_t i = 0; i < shell.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Point& p = shell.points[shell.triangles[i][k]];
      REQUIRE(shell.corner_normals[3 * i + k].dot(p.normalized()) >
              std::cos(2e-3));  // the curve is not a circle
    }
  }
}

TEST_CASE("sweep: normals follow the twist of the frames", "[sweep]") {
  // A flat profile on a closed curve with a large closing angle: without the twist the normals are degrees
  // off.
  SweepScene scene = detail::parse_swp(data_bytes("knot23.swp"), "knot23.swp");
  scene.curves[0] =
      detail::parse_swp("bsp2 p 8 7 [0.6 0][0 0.1][-0.6 0][0 -0.1][0.6 0][0 0.1][-0.6 0]", "p").curves[0];
  const FrameMethod method = GENERATE(FrameMethod::RotationMinimizing, FrameMethod::Projection);
  SweepOptions options;
  options.frames = method;
  scene.curves[0].steps = 64;
  scene.curves[1].steps = 16;
  const double coarse = largest_normal_error(sweep(scene, options).shells.at(0));
  scene.curves[0].steps = 128;
  scene.curves[1].steps = 32;
  const double fine = largest_normal_error(sweep(scene, options).shells.at(0));
  CHECK(coarse < 0.02);
  CHECK(fine < 0.75 * coarse);  // the mean of the faces is itself only of first order
}

TEST_CASE("sweep: a profile that meets the axis gives parts with poles of their own", "[sweep]") {
  SECTION("touching") {
    const Survey found =
        survey(read_text("bez2 p 8 7 [0 2][-2 2][-2 0.5][0 0][-2 -0.5][-2 -2][0 -2] srev s 9 p").shells[0]);
    CHECK(found.components == 2);
    CHECK(found.euler() == 4);
    CHECK(found.least_volume > 0);
  }
  SECTION("crossing at every sample") {
    const Survey found = survey(read_text("bez2 p 5 4 [-1 2] [9 1] [-9 0] [1 -2] srev s 9 p").shells[0]);
    CHECK(found.components == 4);
    CHECK(found.bad_edges == 0);
    CHECK(found.boundary_loops == 2);
  }
  SECTION("a circle that reaches past the axis of its sweep") {
    const Survey found = survey(read_text("circ p 12 1 circ c 16 0.5 gcyl s p c").shells[0]);
    CHECK(found.components == 2);
    CHECK(found.euler() == 4);
    CHECK(found.bad_edges == 0);
    CHECK(found.least_volume > 0);
  }
  SECTION("a circle that just reaches it is pinched") {
    const Model model = read_text("circ p 12 1 circ c 16 1 gcyl s p c");
    REQUIRE(model.diagnostics.size() == 1);
    CHECK(model.diagnostics[0].message.find("pinched") != std::string::npos);
    const Survey found = survey(model.shells[0]);
    CHECK(found.euler() == 2);
    CHECK(found.bad_edges == 0);
  }
  SECTION("symmetric about the axis") {
    const Model model = read_model(data_file("centred_circle.swp"));
    REQUIRE(model.diagnostics.size() == 1);
    CHECK(model.diagnostics[0].message.find("coincide") != std::string::npos);
  }
}

TEST_CASE("sweep: corners of the profile split the patches", "[sweep]") {
  const Model model = read_text(
      "bez2 p 4 10 [0 2] [-0.3 2] [-0.6 2] [-1 2] [-1 1] [-1 1] [-1 0] [-0.7 0] [-0.3 0] [0 0] srev can 12 "
      "p");
  const Shell& can = model.shells.at(0);
  CHECK(patch_names(can) == std::vector<std::string>{"profile 1", "profile 2", "profile 3"});
  std::vector<Diagnostic> diagnostics;
  const auto boundaries = extract_boundaries(model, {}, diagnostics);
  CHECK(boundaries[0].patches[0].loops.size() == 1);
  CHECK(boundaries[0].patches[1].loops.size() == 2);
  CHECK(boundaries[0].patches[2].loops.size() == 1);
  const Survey found = survey(can);
  CHECK(found.euler() == 2);
  CHECK(found.disagreeing == 0);
  for (std::size_t i = 0; i < 3 * can.patches[0].triangle_count; ++i) {
    REQUIRE(can.corner_normals[i] == Vector(0, 1, 0));  // the lid is flat to its rim
  }
}

TEST_CASE("sweep: a smooth closed profile has one patch, one with a corner starts there", "[sweep]") {
  CHECK(read_model(data_file("torus_cw.swp")).shells[0].patches.size() == 1);
  const Shell drop =
      read_text("bez2 p 6 7 [-1 0] [-2 1] [-3 1] [-3 0] [-3 -1] [-2 -1] [-1 0] srev s 12 p").shells.at(0);
  CHECK(drop.patches.size() == 1);
  CHECK(survey(drop).disagreeing == 0);
  std::vector<Diagnostic> diagnostics;
  const Shell two =
      read_text("bez2 p 6 7 [-3 0] [-3 -1] [-2 -1] [-1 0] [-2 1] [-3 1] [-3 0] srev s 12 p").shells.at(0);
  CHECK(two.patches.size() == 1);
}

TEST_CASE("sweep: corners of the sweep are mitred", "[sweep]") {
  const Model model = read_text(kFrame);
  const Shell& frame = model.shells.at(0);
  const Survey found = survey(frame);
  CHECK(found.euler() == 0);
  CHECK(found.components == 1);
  CHECK(found.closed());
  CHECK(found.disagreeing == 0);
  CHECK(found.volume ==
        Approx(2 * 0.5 * 32).epsilon(1e-12));  // the profile is centred on a path of length 32
  CHECK(found.area == Approx(2 * (2 + 0.5) * 32).epsilon(1e-12));
  CHECK(bounding_box(frame).max().isApprox(Point(5, 5, 1.25)));
  CHECK(bounding_box(frame).min().isApprox(Point(-5, -5, 0.75)));
  CHECK(frame.patches.size() == 4 * 4);
  REQUIRE(model.diagnostics.size() == 1);
  CHECK(model.diagnostics[0].text() ==
        "text.swp:1:264: gcyl frame: warning: the sweep has 4 corners of up to 90 degrees");
}

TEST_CASE("sweep: a closed sweep with a corner at its seam stays open there", "[sweep]") {
  const Model model = read_text(
      "circ p 8 0.1 bez3 s 4 10 [0 0 0][1 0 0][2 0 0][3 0 0][3 1 0][3 2 0][3 3 0][2 2 0][1 1 0][0 0 0] gcyl "
      "t p s");
  CHECK(survey(model.shells.at(0)).boundary_loops == 2);
  REQUIRE(model.diagnostics.size() == 2);
  CHECK(model.diagnostics[1].message ==
        "the sweep meets itself at an angle of 135 degrees: the surface stays open there");
}

TEST_CASE("sweep: caps close revolutions and tubes", "[sweep]") {
  SECTION("a revolution") {
    const Shell shell =
        read_text("bez2 p 4 4 [-1 2][-1 1][-1 0][-1 -1] srev s 12 p", with_caps()).shells.at(0);
    const Survey found = survey(shell);
    CHECK(found.euler() == 2);
    CHECK(found.closed());
    CHECK(found.disagreeing == 0);
    CHECK(found.volume == Approx(turned_volume({{1, 2}, {1, -1}}, 12)).epsilon(1e-12));
    CHECK(patch_names(shell) == std::vector<std::string>{"first cap", "profile 1", "last cap"});
  }
  SECTION("a bowl gets a lid") {
    const Survey found =
        survey(read_text("bez2 p 4 4 [1 2][1 1][1 0][0 0] srev s 12 p", with_caps()).shells.at(0));
    CHECK(found.closed());
    CHECK(found.volume > 0);
    CHECK(found.disagreeing == 0);
  }
  SECTION("a tube with a concave profile, either way round") {
    const std::string profile =
        GENERATE(as<std::string>(), "[1 0][0.2 0.2][0 1][-0.2 0.2][-1 0][0 -0.4][1 0][0.2 0.2][0 1]",
                 "[1 0][0 -0.4][-1 0][-0.2 0.2][0 1][0.2 0.2][1 0][0 -0.4][-1 0]");
    const Shell tube =
        read_text("bsp2 p 5 9 " + profile + " bez3 s 6 4 [0 0 0][0 0 5][3 0 8][8 0 8] gcyl t p s",
                  with_caps())
            .shells.at(0);
    const Survey found = survey(tube);
    CHECK(found.euler() == 2);
    CHECK(found.closed());
    CHECK(found.bad_edges == 0);
    CHECK(found.volume > 0);
    CHECK(found.disagreeing == 0);
    CHECK(patch_names(tube) == std::vector<std::string>{"profile 1", "first cap", "last cap"});
    CHECK(tube.patches[1].triangle_count == 30 - 2);
  }
  SECTION("a profile that crosses itself stays open, with a warning") {
    const Model model = read_text(
        "bez2 p 9 7 [0 0][1 1][1 -1][0 0][-1 1][-1 -1][0 0] bez3 s 6 4 [0 0 0][0 0 1][0 0 2][0 0 3] gcyl t p "
        "s",
        with_caps());
    CHECK(survey(model.shells.at(0)).boundary_loops > 0);
    REQUIRE(model.diagnostics.size() == 1);
    CHECK(model.diagnostics[0].message.find("stay open") != std::string::npos);
  }
}

TEST_CASE("sweep: surfaces without area keep an empty shell and a warning", "[sweep]") {
  const std::string text =
      GENERATE(as<std::string>(), "circ p 1 1 circ c 8 3 gcyl s p c", "circ p 2 1 circ c 8 3 gcyl s p c",
               "circ p 8 1 circ c 2 3 gcyl s p c", "bez2 p 8 4 [0 1][0 2][0 3][0 4] srev s 8 p",
               "bez2 p 8 4 [1 1][1 1][1 1][1 1] srev s 8 p",
               "circ p 8 1 bez3 c 100 4 [1 1 1][1 1 1][1 1 1][1 1 1] gcyl s p c",
               "circ p 8 0 bez3 c 9 4 [1 1 1][2 1 1][1 3 1][1 1 4] gcyl s p c");
  const Model model = read_text(text);
  REQUIRE(model.shells.size() == 1);
  CHECK(model.shells[0].triangles.empty());
  CHECK(model.diagnostics.back().message == "the surface is degenerate: it has no area");
}

TEST_CASE("sweep: a profile that reaches past the centre of curvature is reported", "[sweep]") {
  const Model model = read_text("circ p 12 0.5 bez3 s 20 4 [0 0 0] [2 0 0] [0 1 0.2] [2 1 0] gcyl t p s");
  REQUIRE(model.diagnostics.size() == 1);
  CHECK(model.diagnostics[0].message.find("intersects itself") != std::string::npos);
  CHECK(survey(model.shells[0]).bad_edges == 0);
  CHECK(survey(model.shells[0]).disagreeing == 0);
}

TEST_CASE("sweep: cusps are reported", "[sweep]") {
  CHECK(read_text("bez2 loop 8 4 [0 0] [3 2] [-1 2] [2 0]").diagnostics.empty());
  const Model model = read_text("bez2 cusp 8 4 [0 0] [2 2] [0 2] [2 0]");
  REQUIRE(model.diagnostics.size() == 1);
  CHECK(model.diagnostics[0].message == "the curve has 1 cusp, where its tangent reverses");
}

TEST_CASE("sweep: anonymous objects get names that the file does not use", "[sweep]") {
  const Model model =
      read_text("circ . 8 1 circ curve1 8 2 bez2 p 2 4 [1 0][1 1][1 2][1 3] srev . 5 p srev surface1 5 p");
  CHECK(model.curves[0].name == "curve1_");
  CHECK(model.curves[1].name == "curve1");
  CHECK(model.shells[0].id == "surface1_");
  CHECK(model.shells[1].id == "surface1");
}

TEST_CASE("sweep: the frames of a model are limited", "[sweep]") {
  SweepOptions options;
  options.max_frames = 20;
  const Model model = read_text("circ a 8 1 circ b 8 2 circ c 8 3", options);
  CHECK(model.curves[0].frames.size() == 9);
  CHECK(model.curves[1].frames.size() == 9);
  CHECK(model.curves[2].frames.empty());
}

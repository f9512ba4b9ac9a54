#include <algorithm>

#include "read/swp.hpp"
#include "support/catch.hpp"
#include "survey.hpp"

using namespace sweeps;

namespace {

const std::vector<std::string> kFiles = {"beads.swp",    "centred_circle.swp", "crossing.swp",
                                         "knot23.swp",   "sphere.swp",         "torus.swp",
                                         "torus_cw.swp", "start_along_z.swp"};

SweepScene scene_of(const std::string& name) {
  return detail::parse_swp(data_bytes(name), name);
}

bool same_mesh(const Shell& a, const Shell& b) {
  return a.points == b.points && a.triangles == b.triangles && a.corner_normals == b.corner_normals;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace

TEST_CASE("sweep: scaling by a power of two scales every bit", "[sweep][property]") {
  const double factor = GENERATE(0x1p-20, 0.5, 4.0, 0x1p40);
  for (const std::string& name : kFiles) {
    INFO(name << " by " << factor);
    SweepScene scene = scene_of(name);
    const Model before = sweep(scene);
    for (SweepCurve& curve : scene.curves) {
      curve.radius *= factor;
      for (Point& p : curve.control_points) p *= factor;
    }
    Model after = sweep(scene);
    for (std::size_t i = 0; i < before.shells.size(); ++i) {
      for (Point& p : after.shells[i].points) p /= factor;
      CHECK(same_mesh(before.shells[i], after.shells[i]));
    }
  }
}

TEST_CASE("sweep: moving a space curve moves the mesh", "[sweep][property]") {
  const Vector shift(100, -37, 1000);
  for (const std::string name : {"knot23.swp", "start_along_z.swp"}) {
    SweepScene scene = scene_of(name);
    const Model before = sweep(scene);
    for (Point& p : scene.curves.at(1).control_points) p += shift;
    const Model after = sweep(scene);
    const double size = bounding_box(before.shells[0]).diagonal().norm();
    CHECK(before.shells[0].triangles == after.shells[0].triangles);
    for (std::size_t i = 0; i < before.shells[0].points.size(); ++i) {
      REQUIRE((before.shells[0].points[i] + shift - after.shells[0].points[i]).norm() < 1e-12 * size);
    }
  }
}

TEST_CASE("sweep: line ends and blanks have no meaning", "[sweep][property]") {
  for (const std::string& name : kFiles) {
    const std::string text = data_bytes(name);
    const Model plain = read_text(text);
    std::string one_line = replaced(text, "\n", " ");
    one_line.erase(one_line.find_last_not_of(' ') + 1);
    for (const std::string& variant : {replaced(text, "\n", "\r\n"), replaced(text, "\n", "\r"), one_line,
                                       replaced(replaced(text, "[", " [ "), "]", " ] ")}) {
      const Model other = read_text(variant);
      REQUIRE(same_mesh(plain.shells.at(0), other.shells.at(0)));
    }
  }
}

TEST_CASE("sweep: the same bits for any number of threads", "[sweep][property]") {
  SweepScene scene = scene_of("knot23.swp");
  scene.curves[0].steps = 300;
  scene.curves[1].steps = 20;
  SweepOptions options;
  options.threads = 1;
  const Model one = sweep(scene, options);
  options.threads = 3;
  CHECK(same_mesh(one.shells[0], sweep(scene, options).shells[0]));
}

TEST_CASE("sweep: a profile run backwards gives the same solid", "[sweep][property]") {
  for (const std::string name : {"sphere.swp", "torus_cw.swp", "beads.swp"}) {
    SweepScene scene = scene_of(name);
    const Survey before = survey(sweep(scene).shells[0]);
    std::ranges::reverse(scene.curves[0].control_points);
    const Survey after = survey(sweep(scene).shells[0]);
    CHECK(after.area == Approx(before.area).epsilon(1e-12));
    CHECK(after.volume == Approx(before.volume).epsilon(1e-12));
    CHECK(after.least_volume > 0);
    CHECK(after.disagreeing == 0);
  }
}

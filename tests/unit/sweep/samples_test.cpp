// The sample files of data/samples/swp against the table in its README.md.

#include "meshcontour/boundary.hpp"
#include "meshcontour/fit.hpp"
#include "support/catch.hpp"
#include "support/paths.hpp"
#include "survey.hpp"

using namespace sweeps;

namespace {

Model sample(const std::string& name) {
  return read_model(std::filesystem::path(MESHCONTOUR_DATA_DIR "/samples/swp/" + name + ".swp"));
}

}  // namespace

TEST_CASE("samples: surfaces are as the table says", "[sweep][samples]") {
  struct Row {
    std::string name;
    std::size_t vertices, triangles, patches, loops;
    long euler;
  };
  const auto row = GENERATE(values<Row>({
      {"bottle", 3457, 6864, 1, 1, 1},
      {"flower_ring", 4320, 8640, 1, 0, 0},
      {"frame", 320, 640, 16, 0, 0},
      {"goblet", 2642, 5280, 6, 0, 2},
      {"pebbles", 1372, 2736, 2, 0, 4},
      {"torus", 1152, 2304, 1, 0, 0},
      {"unclosed", 1830, 3600, 1, 2, 0},
      {"weird", 1920, 3840, 1, 0, 0},
      {"weirder", 4500, 9000, 1, 0, 0},
  }));
  INFO(row.name);
  const Model model = sample(row.name);
  const Survey found = survey(model.shells.at(0));
  CHECK(found.vertices == row.vertices);
  CHECK(found.faces == row.triangles);
  CHECK(model.shells[0].patches.size() == row.patches);
  CHECK(found.boundary_loops == row.loops);
  CHECK(found.euler() == row.euler);
  CHECK(found.bad_edges == 0);
  CHECK(found.disagreeing == 0);
  CHECK(found.least_volume > 0);
  CHECK(found.least_distance > 1e-9);
}

TEST_CASE("samples: curves alone make a model with a box", "[sweep][samples]") {
  const auto [name, curves] = GENERATE(table<std::string, std::size_t>({
      {"curves", 5},
      {"spline_open", 1},
      {"spline_closed", 1},
  }));
  const Model model = sample(name);
  CHECK(model.shells.empty());
  CHECK(model.curves.size() == curves);
  CHECK(model.diagnostics.empty());
  CHECK(bounding_box(model).diagonal().norm() > 1);
  for (const NamedCurve& curve : model.curves) CHECK_FALSE(curve.frames.empty());
}

TEST_CASE("samples: the rims of the goblet's parts are circles", "[sweep][samples]") {
  const Model model = sample("goblet");
  std::vector<Diagnostic> diagnostics;
  const auto boundaries = extract_boundaries(model, {}, diagnostics);
  FitOptions options;
  options.method = FitMethod::Primitives;
  const auto contours = fit_contours(model, boundaries, options, diagnostics);
  CHECK(contours.size() == 10);
  for (const Contour& contour : contours) {
    REQUIRE(contour.segments.size() == 1);
    const auto* circle = std::get_if<CircularArc>(&contour.segments[0].curve);
    REQUIRE(circle != nullptr);
    CHECK(circle->full());
    CHECK(std::abs(circle->center.x()) + std::abs(circle->center.z()) < 1e-9);
    CHECK(std::abs(circle->axis.y()) == Approx(1));
    const Point rim = model.shells[0].points[contour.segments[0].from];
    CHECK(circle->radius == Approx(std::hypot(rim.x(), rim.z())).epsilon(1e-9));
  }
}

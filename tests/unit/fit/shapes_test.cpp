#include "support/catch.hpp"
#include "support/shape_check.hpp"

using namespace meshcontour;

TEST_CASE("fit_contours: known shapes come apart into their true edges", "[fit][property]") {
  const double tau = GENERATE(1e-4, 1e-5);
  const shapes::Steps steps = GENERATE(shapes::Steps::Adaptive, shapes::Steps::Uniform);
  for (const shapes::Shape& shape : shapes::all()) {
    CAPTURE(shape.name, tau);
    const shapes::Check check = shapes::check_shape(shape, tau, steps, {}, 0);
    CHECK(check.found == shape.kinds());
    CHECK(check.kinds_exact);
    CHECK(check.corners == shape.corners);
    CHECK(check.primitive_error < 1e-12);
  }
}

TEST_CASE("fit_contours: kinds do not depend on place, size, direction or first vertex", "[fit][property]") {
  const shapes::Disturbance disturbance = GENERATE(from_range(shapes::disturbances()));
  if (disturbance.noise > 0) return;
  for (const shapes::Shape& shape : shapes::all()) {
    CAPTURE(shape.name, disturbance.name);
    const shapes::Check check = shapes::check_shape(shape, 1e-4, shapes::Steps::Adaptive, disturbance, 3);
    CHECK(check.found == shape.kinds());
    CHECK(check.corners == shape.corners);
  }
}

TEST_CASE("fit_contours: arcs of ten thousands of chords meet where they meet coarsely", "[fit]") {
  for (const shapes::Shape& shape : shapes::all()) {
    if (shape.kinds().find_first_not_of('A') != std::string::npos) continue;
    CAPTURE(shape.name);
    const shapes::Check check = shapes::check_shape(shape, 1e-10, shapes::Steps::Uniform, {}, 0);
    CHECK(check.found == shape.kinds());
    CHECK(check.corners == shape.corners);
  }
}

TEST_CASE("fit_contours: a polygon of more than ten sides is a circle, of ten it has corners", "[fit]") {
  const auto kinds = [](int sides) {
    return shapes::check_shape(shapes::regular_polygon(sides, 10), 1e-4, shapes::Steps::Uniform, {}, 0);
  };
  CHECK(kinds(10).found == "LLLLLLLLLL");
  CHECK(kinds(10).corners == 10);
  CHECK(kinds(11).found == "C---------- of 1");
}

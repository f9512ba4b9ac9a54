#include "meshcontour/model.hpp"

#include <limits>

#include "support/catch.hpp"

using namespace meshcontour;

namespace {

Model one_triangle() {
  Model model;
  Shell shell;
  shell.id = "s";
  shell.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}};
  shell.triangles = {{0, 1, 2}};
  shell.patches = {{"", {}, 0, 1}};
  model.shells = {shell};
  model.instances = {{0, Eigen::Affine3d::Identity(), ""}};
  return model;
}

}  // namespace

TEST_CASE("bounding_box: unused points do not count, instances do", "[model]") {
  Model model = one_triangle();
  CHECK(bounding_box(model).max() == Point(1, 1, 0));
  model.instances.push_back({0, Eigen::Affine3d(Eigen::Translation3d(5, 0, 0)), ""});
  CHECK(bounding_box(model).max() == Point(6, 1, 0));
  CHECK(bounding_box(Model{}).isEmpty());
}

TEST_CASE("validate: a broken promise is named", "[model][error]") {
  Model model = one_triangle();
  CHECK_NOTHROW(validate(model));
  SECTION("index out of range") {
    model.shells[0].triangles[0][1] = 4;
    CHECK_THROWS_WITH(validate(model), Catch::Contains("shell s") && Catch::Contains("does not exist"));
  }
  SECTION("patches with a gap") {
    model.shells[0].patches[0].triangle_count = 0;
    CHECK_THROWS_WITH(validate(model), Catch::Contains("partition"));
  }
  SECTION("a point that is not finite") {
    model.shells[0].points[0].x() = std::numeric_limits<double>::infinity();
    CHECK_THROWS_WITH(validate(model), Catch::Contains("not finite"));
  }
  SECTION("normals for some corners only") {
    model.shells[0].corner_normals.resize(2);
    CHECK_THROWS_WITH(validate(model), Catch::Contains("three a triangle"));
  }
  SECTION("an instance of nothing") {
    model.instances[0].shell = 1;
    CHECK_THROWS_WITH(validate(model), Catch::Contains("instance"));
  }
}

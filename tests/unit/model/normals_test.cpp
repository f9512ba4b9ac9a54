#include "model/normals.hpp"

#include "support/catch.hpp"
#include "unit/render/solids.hpp"

using namespace meshcontour;
using namespace solids;

namespace {

Eigen::Vector3f outward(const Shell& shell, std::size_t corner) {
  Eigen::Vector3f p = shell.points[shell.triangles[corner / 3][corner % 3]].cast<float>();
  p.z() = 0;
  return p.normalized();
}

}  // namespace

TEST_CASE("lighting_normals: smooth on a cylinder's side, flat on its ends", "[model]") {
  const Shell shell = cylinder(34, 10, 15);
  const auto normals = detail::lighting_normals(shell, 2);
  REQUIRE(normals.size() == 3 * shell.triangles.size());
  for (std::size_t c = 0; c < 3 * 68; ++c) CHECK(normals[c].dot(outward(shell, c)) > 0.9999F);
  for (std::size_t c = 3 * 68; c < 3 * 102; ++c) CHECK(normals[c].z() == -1.0F);
  for (std::size_t c = 3 * 102; c < normals.size(); ++c) CHECK(normals[c].z() == 1.0F);
}

TEST_CASE("lighting_normals: sharp edges inside a patch stay sharp", "[model]") {
  Shell shell = cylinder(34, 10, 15);
  shell.patches = {{"all", {}, 0, shell.triangles.size()}};
  const auto normals = detail::lighting_normals(shell, 1);
  for (std::size_t c = 0; c < 3 * 68; ++c) CHECK(normals[c].dot(outward(shell, c)) > 0.9999F);
  CHECK(normals[3 * 68].z() == -1.0F);
}

TEST_CASE("lighting_normals: the file's are kept, turned to the winding's outside", "[model]") {
  Shell shell = rectangle({0, 0, 0}, {1, 1, 0}, {});
  const Vector tilted = Vector(0.6, 0, 0.8);
  shell.corner_normals.assign(6, tilted);
  for (std::size_t c = 3; c < 6; ++c) shell.corner_normals[c] = -tilted;
  const auto normals = detail::lighting_normals(shell, 1);
  for (const auto& normal : normals) CHECK((normal - tilted.cast<float>()).norm() < 1e-6F);
}

TEST_CASE("lighting_normals: unknown corners are computed, triangles without area have some normal",
          "[model]") {
  Shell shell = rectangle({0, 0, 0}, {1, 1, 0}, {});
  shell.triangles.push_back({0, 0, 1});
  shell.patches[0].triangle_count = 3;
  shell.corner_normals.assign(9, Vector::Zero());
  shell.corner_normals[1] = Vector::UnitX();
  const auto normals = detail::lighting_normals(shell, 1);
  CHECK(normals[0] == Eigen::Vector3f::UnitZ());
  CHECK(normals[1] == Eigen::Vector3f::UnitX());
  for (const auto& normal : normals) CHECK(normal.norm() == Approx(1));
}

TEST_CASE("lighting_normals: a fan of a hundred thousand triangles takes no quadratic time", "[model]") {
  const Shell shell = cylinder(100'000, 10, 15);
  const auto normals = detail::lighting_normals(shell, 2);
  CHECK(normals[3 * 250'000].norm() == Approx(1));
}

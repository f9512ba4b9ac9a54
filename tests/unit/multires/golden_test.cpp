// Reference vectors made by an independent implementation: data/NAME_control.off is subdivided to
// NAME_subdivN.off; NAME_fine.off is analysed into NAME_coarse.off, NAME_details.txt and NAME_integrals.txt.

#include <fstream>
#include <sstream>

#include "meshcontour/wavelet.hpp"
#include "support/catch.hpp"
#include "support/paths.hpp"

using namespace meshcontour;

namespace {

struct Mesh {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
};

std::string data_file(const std::string& name) {
  return std::string(MESHCONTOUR_TESTS_DIR) + "/unit/multires/data/" + name;
}

Mesh read_off(const std::string& name) {
  std::ifstream in(data_file(name));
  std::string word;
  std::size_t vertices = 0, triangles = 0, edges = 0, corners = 0;
  in >> word >> vertices >> triangles >> edges;
  Mesh mesh;
  mesh.points.resize(vertices);
  mesh.triangles.resize(triangles);
  for (Point& p : mesh.points) in >> p.x() >> p.y() >> p.z();
  for (Triangle& t : mesh.triangles) in >> corners >> t[0] >> t[1] >> t[2];
  REQUIRE(in);
  return mesh;
}

double diagonal(const Mesh& mesh) {
  Box box;
  for (const Point& p : mesh.points) box.extend(p);
  return box.diagonal().norm();
}

Shell shell_of(const Mesh& mesh) {
  Shell shell;
  shell.points = mesh.points;
  shell.triangles = mesh.triangles;
  shell.patches = {{"", {}, 0, mesh.triangles.size()}};
  return shell;
}

struct Case {
  std::string name;
  unsigned levels;
  BoundaryRule rule;
};

Case golden_case() {
  return GENERATE(values<Case>({{"tetra", 3, BoundaryRule::Reflect},
                                {"bipyramid12", 2, BoundaryRule::Reflect},
                                {"open", 3, BoundaryRule::Reflect},
                                {"open_trig", 3, BoundaryRule::Trigonometric}}));
}

}  // namespace

TEST_CASE("subdivided: equal to the reference, vertex for vertex", "[multires]") {
  const auto [name, levels, rule] = golden_case();
  CAPTURE(name);
  const Mesh control = read_off(name + "_control.off");
  const Mesh expected = read_off(name + "_subdiv" + std::to_string(levels) + ".off");
  const Shell fine = subdivided(shell_of(control), levels, {.boundary = rule});
  REQUIRE(fine.points.size() == expected.points.size());
  CHECK(fine.triangles == expected.triangles);
  double worst = 0;
  for (std::size_t i = 0; i < fine.points.size(); ++i) {
    worst = std::max(worst, (fine.points[i] - expected.points[i]).norm());
  }
  CHECK(worst <= 1e-14 * diagonal(expected));
}

TEST_CASE("WaveletTransform: coarse mesh, details and integrals equal the reference", "[multires]") {
  const auto [name, levels, rule] = golden_case();
  CAPTURE(name);
  const Mesh coarse = read_off(name + "_coarse.off"), fine = read_off(name + "_fine.off");
  const double size = diagonal(fine);
  const WaveletTransform transform(coarse.triangles, static_cast<Index>(coarse.points.size()), levels,
                                   {.boundary = rule});
  REQUIRE(transform.vertex_count(levels) == fine.points.size());
  std::vector<Point> points = fine.points;
  transform.analyse(points);
  double worst = 0;
  for (std::size_t i = 0; i < coarse.points.size(); ++i)
    worst = std::max(worst, (points[i] - coarse.points[i]).norm());
  CHECK(worst <= 1e-13 * size);

  std::ifstream details(data_file(name + "_details.txt"));
  std::string line;
  std::getline(details, line);
  std::size_t rows = 0;
  for (; std::getline(details, line); ++rows) {
    std::istringstream in(line);
    std::size_t level = 0, vertex = 0;
    Point d;
    double integral = 0;
    in >> level >> vertex >> d.x() >> d.y() >> d.z() >> integral;
    CHECK((points[vertex] - d).norm() <= 1e-13 * size);
    CHECK(transform.integrals(static_cast<unsigned>(level) + 1)[vertex] == Approx(integral).epsilon(1e-13));
  }
  CHECK(rows == fine.points.size() - coarse.points.size());

  transform.synthesise(points);
  worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    worst = std::max(worst, (points[i] - fine.points[i]).norm());
  CHECK(worst <= 1e-14 * size);
}

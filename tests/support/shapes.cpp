#include "support/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace shapes {

using meshcontour::Index;
using meshcontour::Vector;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kWidest = 0.5;  // radians that a chord may turn

double turn_between(const Vector& a, const Vector& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Edge free(std::function<Point(double)> at, double begin, double end) {
  return {'S', std::move(at), begin, end, 0, 0};
}

Edge ellipse(double a, double b, double begin, double end) {
  return {'E', [=](double t) { return Point(a * std::cos(t), b * std::sin(t), 0); }, begin, end, 0, 0};
}

Point polar(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle), 0};
}

Shape polygon(std::string name, const std::vector<Point>& corners) {
  Shape shape{std::move(name), {}, static_cast<int>(corners.size())};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    shape.edges.push_back(line(corners[i], corners[(i + 1) % corners.size()]));
  }
  return shape;
}

Eigen::Affine3d tilt(double about_x, double about_z) {
  return Eigen::Affine3d(Eigen::AngleAxisd(about_z, Vector::UnitZ()) *
                         Eigen::AngleAxisd(about_x, Vector::UnitX()));
}

Shape circle34() {
  Shape shape{"circle34", {arc({0, 0, 0}, 10, 0, 2 * kPi)}, 0};
  shape.edges[0].chords = 34;
  return shape;
}

Shape stadium() {
  return {"stadium",
          {line({0, -5, 0}, {20, -5, 0}), arc({20, 0, 0}, 5, -kPi / 2, kPi / 2), line({20, 5, 0}, {0, 5, 0}),
           arc({0, 0, 0}, 5, kPi / 2, 1.5 * kPi)},
          0};
}

Shape rounded_rectangle() {
  const double w = 40, h = 25, r = 4;
  return {"rrect",
          {line({r, 0, 0}, {w - r, 0, 0}), arc({w - r, r, 0}, r, -kPi / 2, 0), line({w, r, 0}, {w, h - r, 0}),
           arc({w - r, h - r, 0}, r, 0, kPi / 2), line({w - r, h, 0}, {r, h, 0}),
           arc({r, h - r, 0}, r, kPi / 2, kPi), line({0, h - r, 0}, {0, r, 0}),
           arc({r, r, 0}, r, kPi, 1.5 * kPi)},
          0};
}

Shape gear() {
  const double outer = 20, inner = 16, pitch = 2 * kPi / 12;
  Shape shape{"gear12", {}, 48};
  for (int tooth = 0; tooth < 12; ++tooth) {
    const double a = tooth * pitch;
    shape.edges.push_back(arc({0, 0, 0}, outer, a - 0.12 * pitch, a + 0.12 * pitch));
    shape.edges.push_back(line(polar(outer, a + 0.12 * pitch), polar(inner, a + 0.22 * pitch)));
    shape.edges.push_back(arc({0, 0, 0}, inner, a + 0.22 * pitch, a + 0.78 * pitch));
    shape.edges.push_back(line(polar(inner, a + 0.78 * pitch), polar(outer, a + 0.88 * pitch)));
  }
  return shape;
}

// A NACA four-digit section of 12 % with a closed trailing edge.
Shape airfoil() {
  const auto at = [](double u) {
    const double x = u * u, camber = 0.02, place = 0.4;
    const double half = 0.6 * (0.2969 * std::abs(u) - 0.1260 * x - 0.3516 * x * x + 0.2843 * x * x * x -
                               0.1036 * x * x * x * x);
    const double mean = x < place
                            ? camber / (place * place) * (2 * place * x - x * x)
                            : camber / ((1 - place) * (1 - place)) * (1 - 2 * place + 2 * place * x - x * x);
    return Point(100 * x, 100 * (mean + (u < 0 ? -half : half)), 0);
  };
  return {"airfoil", {free(at, 1, -1)}, 1};
}

Shape helix_patch() {
  const double turns = 2 * kPi * 1.3;
  const auto low = [](double t) { return Point(10 * std::cos(t), 10 * std::sin(t), 6 * t / (2 * kPi)); };
  const auto high = [low](double t) { return Point(low(t) + Point(0, 0, 8)); };
  return {"helixpatch",
          {free(low, 0, turns), line(low(turns), high(turns)), free(high, turns, 0), line(high(0), low(0))},
          4};
}

Shape saddle() {
  const auto at = [](double t) {
    const double x = 6 * std::cos(t);
    return Point(x, 6 * std::sin(t), std::sqrt(100 - x * x));
  };
  return {"saddle", {free(at, 0, 2 * kPi)}, 0};
}

Shape lens() {
  const double a = std::acos(0.6);
  return {"lens", {arc({-6, 0, 0}, 10, -a, a), arc({6, 0, 0}, 10, kPi - a, kPi + a)}, 2};
}

Shape keyhole() {
  const double r = 6, w = 2, h = 14, a = std::asin(w / r), y = -r * std::cos(a);
  return {"keyhole",
          {arc({0, 0, 0}, r, -kPi / 2 + a, 1.5 * kPi - a), line({-w, y, 0}, {-w, -h, 0}),
           line({-w, -h, 0}, {w, -h, 0}), line({w, -h, 0}, {w, y, 0})},
          4};
}

// Four tangent arcs of two radii.
Shape oval() {
  const double large = 20, small = 6, e = 10, d = std::sqrt((large - small) * (large - small) - e * e);
  const double a = std::atan2(d, e);
  return {"oval4",
          {arc({e, 0, 0}, small, -a, a), arc({0, -d, 0}, large, a, kPi - a),
           arc({-e, 0, 0}, small, kPi - a, kPi + a), arc({0, d, 0}, large, kPi + a, 2 * kPi - a)},
          0};
}

Shape wavy_plate() {
  const auto at = [](double t) {
    return Point(t, 20 + 2 * std::sin(t * 2 * kPi / 40) + 0.7 * std::sin(t * 2 * kPi / 17), 0);
  };
  return {"wavyplate",
          {line({0, 0, 0}, {60, 0, 0}), line({60, 0, 0}, at(60)), free(at, 60, 0), line(at(0), {0, 0, 0})},
          4};
}

Shape shallow_bends() {
  return polygon(
      "bend12",
      {{0, 0, 0}, {30, 0, 0}, {60, 30 * std::tan(12 * kPi / 180), 0}, {60, 40, 0}, {30, 44, 0}, {0, 40, 0}});
}

// Lines joined by a quintic with the tangents and curvatures of both, and two fillets.
Shape blend() {
  const auto at = [](double s) {
    return Point(10 + 20 * s, 10 * (6 * std::pow(s, 5) - 15 * std::pow(s, 4) + 10 * std::pow(s, 3)), 0);
  };
  return {"blendspline",
          {line({0, 0, 0}, {10, 0, 0}), free(at, 0, 1), line({30, 10, 0}, {45, 10, 0}),
           arc({45, 15, 0}, 5, -kPi / 2, kPi / 2), line({45, 20, 0}, {4, 20, 0}),
           arc({4, 16, 0}, 4, kPi / 2, kPi), line({0, 16, 0}, {0, 0, 0})},
          1};
}

Shape cut_hole() {
  const double t = 2.2;
  const Shape flat{"cylhole",
                   {ellipse(12, 7, -t, t),
                    line({12 * std::cos(t), 7 * std::sin(t), 0}, {12 * std::cos(t), -7 * std::sin(t), 0})},
                   2};
  return moved(flat, tilt(0.9, 0.3));
}

struct ChordError {
  double sagitta = 0, turn = 0;
};

ChordError chord_error(const Edge& edge, double from, double to) {
  Point p[9];
  for (int i = 0; i < 9; ++i) p[i] = edge.at(from + (to - from) * i / 8);
  const Vector chord = p[8] - p[0];
  const double length = chord.norm();
  ChordError error;
  if (!(length > 0)) return {(p[4] - p[0]).norm(), kPi};
  for (const Point& q : p) error.sagitta = std::max(error.sagitta, (q - p[0]).cross(chord).norm() / length);
  error.turn = turn_between(p[1] - p[0], p[8] - p[7]);
  return error;
}

bool is_fine(const Edge& edge, double from, double to, double sagitta) {
  const ChordError error = chord_error(edge, from, to);
  return error.sagitta <= sagitta && error.turn <= kWidest;
}

std::vector<double> equal_steps(const Edge& edge, int chords) {
  std::vector<double> t;
  for (int i = 0; i <= chords; ++i) t.push_back(edge.begin + (edge.end - edge.begin) * i / chords);
  return t;
}

std::vector<double> uniform_steps(const Edge& edge, double sagitta) {
  for (int chords = 2;; chords = chords < 64 ? chords + 1 : chords * 11 / 10) {
    const std::vector<double> t = equal_steps(edge, chords);
    bool fine = true;
    for (int i = 0; i < chords && fine; ++i)
      fine = is_fine(edge, t[std::size_t(i)], t[std::size_t(i) + 1], sagitta);
    if (fine) return t;
  }
}

std::vector<double> adaptive_steps(const Edge& edge, double sagitta) {
  const double span = edge.end - edge.begin;
  std::vector<double> t = {edge.begin};
  for (double step = span / 8; std::abs(edge.end - t.back()) > 1e-12 * std::abs(span);) {
    const double rest = edge.end - t.back();
    step = std::abs(step * 1.6) > std::abs(rest) ? rest : step * 1.6;
    while (!is_fine(edge, t.back(), t.back() + step, sagitta)) step *= 0.93;
    t.push_back(t.back() + step);
  }
  t.back() = edge.end;
  const std::size_t n = t.size();
  if (n > 3 && std::abs(t[n - 1] - t[n - 2]) < 0.4 * std::abs(t[n - 2] - t[n - 3]))
    t[n - 2] = (t[n - 1] + t[n - 3]) / 2;
  return t;
}

std::vector<double> steps_of(const Edge& edge, double sagitta, Steps steps) {
  if (edge.kind == 'L') return {edge.begin, edge.end};
  if (edge.kind == 'A' || edge.kind == 'C') {
    const double widest = std::min(2 * std::acos(std::max(1 - sagitta / edge.radius, -1.0)), kWidest);
    const int chords =
        std::max(1, static_cast<int>(std::ceil(std::abs(edge.end - edge.begin) / widest - 1e-9)));
    return equal_steps(edge, edge.chords > 0 ? edge.chords : chords);
  }
  return steps == Steps::Uniform ? uniform_steps(edge, sagitta) : adaptive_steps(edge, sagitta);
}

}  // namespace

std::string Shape::kinds() const {
  std::string text;
  for (const Edge& edge : edges) text += edge.kind;
  return text;
}

Edge line(const Point& from, const Point& to) {
  return {'L', [=](double t) { return Point(from + t * (to - from)); }, 0, 1, 0, 0};
}

Edge arc(const Point& center, double radius, double begin, double end) {
  const bool full = std::abs(std::abs(end - begin) - 2 * kPi) < 1e-12;
  return {
      full ? 'C' : 'A', [=](double t) { return Point(center + polar(radius, t)); }, begin, end, radius, 0};
}

Shape regular_polygon(int sides, double radius) {
  std::vector<Point> corners;
  for (int k = 0; k < sides; ++k) corners.push_back(polar(radius, 2 * kPi * k / sides));
  return polygon("polygon" + std::to_string(sides), corners);
}

std::vector<Shape> all() {
  std::vector<Shape> shapes = {circle34(),
                               polygon("square", {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}}),
                               regular_polygon(6, 10),
                               stadium(),
                               rounded_rectangle(),
                               gear()};
  shapes[2].name = "hexagon";
  Eigen::Affine3d place = tilt(0.4, 0.7);
  place.pretranslate(Vector(3, -2, 5));
  shapes.push_back(moved({"ellipse", {ellipse(20, 8, 0, 2 * kPi)}, 0}, place));
  shapes.push_back(airfoil());
  shapes.push_back(helix_patch());
  shapes.push_back(saddle());
  shapes.push_back({"dshape", {arc({0, 0, 0}, 8, -kPi / 2, kPi / 2), line({0, 8, 0}, {0, -8, 0})}, 2});
  shapes.push_back(lens());
  shapes.push_back(keyhole());
  shapes.push_back(oval());
  shapes.push_back(wavy_plate());
  shapes.push_back(shallow_bends());
  shapes.push_back(blend());
  shapes.push_back(cut_hole());
  return shapes;
}

Shape rounded_polygon(std::mt19937& random) {
  const auto uniform = [&](double from, double to) {
    return from + (to - from) * static_cast<double>(random()) / 4294967296.0;
  };
  const int sides = 3 + static_cast<int>(random() % 6);
  std::vector<Point> corners;
  for (int k = 0; k < sides; ++k)
    corners.push_back(polar(uniform(25, 50), 2 * kPi * (k + uniform(-0.25, 0.25)) / sides));
  Shape shape{"rounded" + std::to_string(sides), {}, 0};
  std::vector<Point> ins, outs, centers;
  std::vector<double> radii, begins, sweeps;
  for (int k = 0; k < sides; ++k) {
    const Point& here = corners[std::size_t(k)];
    const Vector in = here - corners[std::size_t((k + sides - 1) % sides)];
    const Vector out = corners[std::size_t((k + 1) % sides)] - here;
    const double turn = std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
    const double room = 0.4 * std::min(in.norm(), out.norm());
    const double tangent = uniform(0.2, 1) * room, radius = tangent / std::tan(std::abs(turn) / 2);
    const Vector left = Vector(-in.y(), in.x(), 0).normalized() * (turn > 0 ? 1 : -1);
    const Point start = here - tangent * in.normalized(), center = start + radius * left;
    ins.push_back(start);
    outs.push_back(here + tangent * out.normalized());
    centers.push_back(center);
    radii.push_back(radius);
    begins.push_back(std::atan2(start.y() - center.y(), start.x() - center.x()));
    sweeps.push_back(turn);
  }
  for (std::size_t k = 0; k < corners.size(); ++k) {
    shape.edges.push_back(arc(centers[k], radii[k], begins[k], begins[k] + sweeps[k]));
    shape.edges.push_back(line(outs[k], ins[(k + 1) % corners.size()]));
  }
  return moved(shape, tilt(uniform(0, 3), uniform(0, 3)));
}

Shape moved(const Shape& shape, const Eigen::Affine3d& map) {
  Shape result = shape;
  const double scale = std::cbrt(std::abs(map.linear().determinant()));
  for (Edge& edge : result.edges) {
    edge.radius *= scale;
    edge.at = [map, at = edge.at](double t) { return Point(map * at(t)); };
  }
  return result;
}

double size(const Shape& shape) {
  meshcontour::Box box;
  for (const Edge& edge : shape.edges) {
    for (int i = 0; i <= 400; ++i) box.extend(edge.at(edge.begin + (edge.end - edge.begin) * i / 400));
  }
  return box.diagonal().norm();
}

Loop tessellate(const Shape& shape, double sagitta, Steps steps) {
  Loop loop;
  for (const Edge& edge : shape.edges) {
    loop.joints.push_back(loop.points.size());
    const std::vector<double> t = steps_of(edge, sagitta, steps);
    for (std::size_t i = 0; i + 1 < t.size(); ++i) loop.points.push_back(edge.at(t[i]));
  }
  return loop;
}

meshcontour::Model model_of(const std::vector<Point>& loop) {
  meshcontour::Model model;
  meshcontour::Shell& shell = model.shells.emplace_back();
  shell.id = "shape";
  shell.points = loop;
  Point middle = Point::Zero();
  for (const Point& p : loop) middle += p / static_cast<double>(loop.size());
  shell.points.push_back(middle);
  const auto n = static_cast<Index>(loop.size());
  for (Index i = 0; i < n; ++i) shell.triangles.push_back({i, (i + 1) % n, n});
  shell.patches.push_back({"1", {}, 0, shell.triangles.size()});
  return model;
}

std::vector<meshcontour::ShellBoundary> boundary_of(const std::vector<Point>& loop) {
  std::vector<meshcontour::ShellBoundary> boundaries(1);
  meshcontour::PatchBoundary& patch = boundaries[0].patches.emplace_back();
  std::vector<Index> vertices(loop.size());
  std::iota(vertices.begin(), vertices.end(), Index{0});
  patch.loops = {meshcontour::BoundaryLoop{std::move(vertices), true}};
  patch.vertex_count = loop.size();
  return boundaries;
}

}  // namespace shapes

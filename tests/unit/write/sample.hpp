#pragma once

// A small model with every kind of curve, made by hand: patch 1 of a shell has a loop of a line, an arc, an
// elliptical arc and a spline; patch 2 a full circle, a full ellipse, a periodic spline and a polygon. The
// curves are exact; the loops' vertices are only their ends, so that a reader can check one against the
// other.

#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "meshcontour/write.hpp"

namespace meshcontour {

struct Sample {
  Model model;
  std::vector<ShellBoundary> boundaries;
  std::vector<Contour> contours;

  Result result() const { return {model, boundaries, contours}; }
};

inline Eigen::Affine3d placement(const Vector& shift, double angle, const Vector& axis, double scale = 1) {
  return Eigen::Translation3d(shift) * Eigen::AngleAxisd(angle, axis.normalized()) * Eigen::Scaling(scale);
}

/// A half turn about (20, 5, 0) joins the lines' ends; all of it lies in the plane z = 0.
inline std::vector<Segment> open_kinds() {
  const Vector z = Vector::UnitZ();
  LineSegment line{{0, 0, 0}, {20, 0, 0}};
  CircularArc arc{{20, 0, 0}, {20, 10, 0}, {20, 5, 0}, z, 5, std::numbers::pi};
  EllipticalArc ellipse{{20, 10, 0}, {16, 12, 0}, {16, 10, 0}, z, {4, 0, 0}, 0.5, std::numbers::pi / 2};
  BSplineCurve spline;
  spline.knots = {0, 0, 0, 0, 0.25, 1, 1, 1, 1};
  spline.control_points = {{16, 12, 0}, {10, 15, 0}, {5, 11, 0}, {-3, 6, 0}, {0, 0, 0}};
  return {{0, 1, line}, {1, 2, arc, 1e-6}, {2, 3, ellipse}, {3, 0, spline}};
}

inline BSplineCurve periodic_spline() {
  BSplineCurve curve;
  curve.periodic = true;
  for (const auto& [x, y] : {std::pair{0, 0}, {4, 0}, {5, 3}, {2, 5}, {-1, 3}})
    curve.control_points.emplace_back(x, y, 30);
  for (std::size_t i = 0; i < 3; ++i) curve.control_points.push_back(curve.control_points[i]);
  for (std::size_t i = 0; i < curve.control_points.size() + 4; ++i)
    curve.knots.push_back(static_cast<double>(i));
  return curve;
}

inline BSplineCurve rational_spline() {
  return to_clamped_bspline(
      Curve(CircularArc{{3, 0, 40}, {0, 3, 40}, {0, 0, 40}, {0, 0, 1}, 3, std::numbers::pi / 2}));
}

inline NamedCurve named(const std::string& name, const Curve& curve) {
  NamedCurve result;
  result.name = name;
  result.curve = curve;
  return result;
}

inline Sample sample() {
  Sample s;
  s.model.name = "sample";
  s.model.metres_per_unit = 0.001;
  Shell shell;
  shell.id = "id7";
  const BSplineCurve periodic = periodic_spline();
  shell.points = {{0, 0, 0},
                  {20, 0, 0},
                  {20, 10, 0},
                  {16, 12, 0},
                  {7, 0, 10},
                  {8, 0, 20},
                  evaluate(periodic, periodic.domain().first),
                  {0, 0, 50},
                  {1, 0, 50},
                  {1, 1, 51}};
  shell.triangles = {{0, 1, 2}, {7, 8, 9}};
  shell.patches = {{"", {}, 0, 1}, {"", {}, 1, 1}};
  s.model.shells = {shell};
  s.model.instances = {{0, Eigen::Affine3d::Identity(), "root"}};

  PatchBoundary first, second;
  first.loops = {{{0, 1, 2, 3}, true}};
  first.edges = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  second.loops = {{{4}, true}, {{5}, true}, {{6}, true}, {{7, 8, 9}, true}};
  second.edges = {{7, 8}, {8, 9}, {9, 7}};
  s.boundaries = {{{first, second}}};

  const Vector z = Vector::UnitZ();
  const double turn = 2 * std::numbers::pi;
  const CircularArc circle{{7, 0, 10}, {7, 0, 10}, {0, 0, 10}, z, 7, turn};
  const EllipticalArc ellipse{{8, 0, 20}, {8, 0, 20}, {0, 0, 20}, z, {8, 0, 0}, 0.25, turn};
  s.contours = {{0, 0, 0, true, open_kinds(), 1e-6},
                {0, 1, 0, true, {{4, 4, circle}}},
                {0, 1, 1, true, {{5, 5, ellipse}}},
                {0, 1, 2, true, {{6, 6, periodic}}}};
  Contour polygon{0, 1, 3, true, {}};
  polygon.fallback = true;
  for (const auto& [from, to] : {std::pair<Index, Index>{7, 8}, {8, 9}, {9, 7}}) {
    polygon.segments.push_back({from, to, LineSegment{shell.points[from], shell.points[to]}});
  }
  s.contours.push_back(polygon);
  return s;
}

inline void open_loop(PatchBoundary& patch, std::size_t number) {
  std::vector<BoundaryLoop> loops(patch.loops.begin(), patch.loops.end());
  loops[number].closed = false;
  patch.loops = std::move(loops);
}

inline std::string written(OutputFormat format, const Sample& sample, const WriteOptions& options = {},
                           std::vector<Diagnostic>* notes = nullptr) {
  StringSink sink;
  std::vector<Diagnostic> ignored;
  write_output(format, sample.result(), options, sink, notes != nullptr ? *notes : ignored);
  return sink.text;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    lines.push_back(text.substr(at, end - at));
    at = end == text.npos ? text.size() : end + 1;
  }
  return lines;
}

}  // namespace meshcontour

// Processor time of whole loops and of the least squares alone, from ten thousand vertices to a million: it
// has to grow no faster than the loops.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "bench/bench.hpp"
#include "fit/least_squares.hpp"
#include "meshcontour/fit.hpp"
#include "support/shapes.hpp"

using namespace meshcontour;

namespace {

// Vertices at equal steps of the parameter, shared out among the curved edges.
std::vector<Point> even_points(const shapes::Shape& shape, std::size_t count) {
  std::size_t curved = 0;
  for (const shapes::Edge& edge : shape.edges) curved += edge.kind != 'L';
  std::vector<Point> points;
  for (const shapes::Edge& edge : shape.edges) {
    const std::size_t chords = edge.kind == 'L' ? 1 : count / curved;
    for (std::size_t i = 0; i < chords; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(chords);
      points.push_back(edge.at(edge.begin + (edge.end - edge.begin) * share));
    }
  }
  return points;
}

struct Fitted {
  double seconds = 0;
  std::size_t segments = 0, control_points = 0;
};

Fitted fit_loop(const std::vector<Point>& points) {
  const Model model = shapes::model_of(points);
  const std::vector<ShellBoundary> boundaries = shapes::boundary_of(points);
  FitOptions options;
  options.threads = 1;
  Fitted fitted;
  std::vector<Diagnostic> diagnostics;
  const double start = bench::cpu_seconds();
  const std::vector<Contour> contours = fit_contours(model, boundaries, options, diagnostics);
  fitted.seconds = bench::cpu_seconds() - start;
  fitted.segments = contours.at(0).segments.size();
  for (const Segment& segment : contours[0].segments) {
    const auto* spline = std::get_if<BSplineCurve>(&segment.curve);
    if (spline != nullptr) fitted.control_points += spline->control_points.size();
  }
  return fitted;
}

void print_loops(const std::string& only) {
  fmt::print("{:12} {:>9} {:>8} {:>8} {:>9} {:>7}\n", "loop", "vertices", "segments", "controls", "seconds",
             "ratio");
  for (const shapes::Shape& shape : shapes::all()) {
    if (shape.kinds().find_first_not_of('L') == std::string::npos) continue;
    if (!only.empty() && shape.name != only) continue;
    double before = 0;
    for (const std::size_t count : {10'000, 100'000, 1'000'000}) {
      const std::vector<Point> points = even_points(shape, count);
      const Fitted fitted = fit_loop(points);
      fmt::print("{:12} {:9} {:8} {:8} {:9.4f} {:7.1f}\n", shape.name, points.size(), fitted.segments,
                 fitted.control_points, fitted.seconds, before > 0 ? fitted.seconds / before : 0);
      std::fflush(stdout);
      before = fitted.seconds;
    }
  }
}

void print_least_squares() {
  const std::size_t count = 1'000'000, spans = 500'000;
  const double period = 2 * std::numbers::pi;
  std::vector<Point> points;
  std::vector<double> parameters, knots;
  for (std::size_t i = 0; i < count; ++i) {
    parameters.push_back(period * static_cast<double>(i) / static_cast<double>(count));
    points.emplace_back(std::cos(parameters[i]), std::sin(parameters[i]), std::sin(2 * parameters[i]));
  }
  for (std::size_t k = 0; k < spans + 7; ++k) {
    knots.push_back(period * (static_cast<double>(k) - 3) / static_cast<double>(spans));
  }
  detail::CubicLeastSquares solver;
  std::vector<Point> control_points;
  const double start = bench::cpu_seconds();
  const bool solved = solver.solve_closed(knots, points, parameters, control_points);
  fmt::print("least squares, {} points, {} spans: {:.3f} s{}\n", count, spans, bench::cpu_seconds() - start,
             solved ? "" : ", not solved");
}

}  // namespace

// Argument: the name of a shape; none: all.
int main(int count, char** arguments) {
  print_least_squares();
  print_loops(count > 1 ? arguments[1] : "");
}

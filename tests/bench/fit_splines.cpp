// Smooth runs of known curves as B-splines: control points, certificate and time; as JSON, with the points
// and the fitted curves, for spline_peers.py, which sets other libraries beside it.

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bench/bench.hpp"
#include "fit/spline_run.hpp"
#include "support/shapes.hpp"

using namespace meshcontour;
using nlohmann::json;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kTruthSamples = 20'000;
constexpr double kEnoughSeconds = 0.05;  // a time is the shortest of runs that take this long together

struct Run {
  std::string name;
  shapes::Edge edge;
  bool closed = false;
};

std::vector<Run> smooth_runs() {
  std::vector<Run> runs{{"circle", shapes::arc({0, 0, 0}, 10, 0, kTurn), true}};
  for (const shapes::Shape& shape : shapes::all()) {
    const bool closed = shape.edges.size() == 1 && shape.corners == 0;
    if (shape.edges[0].kind == 'E' && closed) runs.push_back({shape.name, shape.edges[0], true});
    for (const shapes::Edge& edge : shape.edges) {
      if (edge.kind != 'S') continue;
      runs.push_back({shape.name, edge, closed});
      break;
    }
  }
  return runs;
}

json as_json(const std::vector<Point>& points) {
  json list = json::array();
  for (const Point& p : points) list.push_back({p.x(), p.y(), p.z()});
  return list;
}

std::vector<Point> even_points(const Run& run, int chords) {
  std::vector<Point> points;
  for (int i = 0; i < chords + (run.closed ? 0 : 1); ++i) {
    points.push_back(run.edge.at(run.edge.begin + (run.edge.end - run.edge.begin) * i / chords));
  }
  return points;
}

std::vector<Point> tessellated(const Run& run, double sagitta) {
  const shapes::Loop loop = shapes::tessellate({run.name, {run.edge}, 0}, sagitta, shapes::Steps::Adaptive);
  std::vector<Point> points = loop.points;
  if (!run.closed) points.push_back(run.edge.at(run.edge.end));
  return points;
}

double diagonal(const std::vector<Point>& points) {
  Box box;
  for (const Point& p : points) box.extend(p);
  return box.diagonal().norm();
}

json fitted(const Run& run, const std::vector<Point>& points, double tolerance) {
  detail::SplineRunOptions options;
  options.tolerance = tolerance * diagonal(points);
  options.closed = run.closed;
  detail::SplineRun result;
  double shortest = 1e9, total = 0;
  while (total < kEnoughSeconds) {
    const double start = bench::cpu_seconds();
    result = detail::fit_spline_run(points, options);
    const double seconds = bench::cpu_seconds() - start;
    shortest = std::min(shortest, seconds);
    total += seconds;
  }
  const std::size_t repeated = run.closed ? 3 : 0;
  return {{"run", run.name},
          {"tolerance", options.tolerance},
          {"relative_tolerance", tolerance},
          {"accepted", result.accepted},
          {"seconds", shortest},
          {"deviation", result.deviation},
          {"vertex_error", result.vertex_error},
          {"control_count", result.curve.control_points.size() - repeated},
          {"knots", result.curve.knots},
          {"control_points", as_json(result.curve.control_points)},
          {"points", as_json(points)}};
}

}  // namespace

// Argument: the file to write.
int main(int count, char** arguments) {
  if (count != 2) return 64;
  json truth = json::object(), fits = json::array(), sizes = json::array();
  for (const Run& run : smooth_runs()) {
    truth[run.name] = {{"closed", run.closed}, {"points", as_json(even_points(run, kTruthSamples))}};
    const double size = diagonal(even_points(run, 400));
    for (const double sagitta : {1e-3, 1e-4}) {
      for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
        fits.push_back(fitted(run, tessellated(run, sagitta * size), tolerance));
        fits.back()["sagitta"] = sagitta;
      }
    }
    for (const int chords : {34, 1'000, 100'000})
      sizes.push_back(fitted(run, even_points(run, chords), 1e-4));
  }
  std::ofstream(arguments[1]) << json{{"truth", truth}, {"fits", fits}, {"sizes", sizes}};
}

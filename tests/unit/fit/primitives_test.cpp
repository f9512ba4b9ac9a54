#include <cmath>
#include <map>
#include <numbers>

#include "meshcontour/fit.hpp"
#include "meshcontour/read.hpp"
#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/shapes.hpp"

using namespace meshcontour;

namespace {

constexpr double kPi = std::numbers::pi;

struct Fitted {
  Model model;
  std::vector<ShellBoundary> boundaries;
  std::vector<Contour> contours;
  std::vector<Diagnostic> diagnostics;
};

FitOptions primitives(unsigned threads = 1) {
  FitOptions options;
  options.method = FitMethod::Primitives;
  options.threads = threads;
  return options;
}

Fitted fit(Model model, const FitOptions& options = primitives()) {
  Fitted fitted{std::move(model), {}, {}, {}};
  fitted.boundaries = extract_boundaries(fitted.model, {}, fitted.diagnostics);
  fitted.contours = fit_contours(fitted.model, fitted.boundaries, options, fitted.diagnostics);
  return fitted;
}

Fitted fit_loop(const std::vector<Point>& points) {
  Fitted fitted{shapes::model_of(points), shapes::boundary_of(points), {}, {}};
  fitted.contours = fit_contours(fitted.model, fitted.boundaries, primitives(), fitted.diagnostics);
  return fitted;
}

std::string kinds(const Contour& contour) {
  std::string text;
  for (const Segment& segment : contour.segments) {
    const auto* arc = std::get_if<CircularArc>(&segment.curve);
    const char names[] = {'L', 'A', 'E', 'S'};
    text += arc && arc->full() ? 'C' : names[segment.curve.index()];
  }
  return text;
}

// Exactly equal, number by number.
bool same_bits(const Curve& a, const Curve& b) {
  if (a.index() != b.index()) return false;
  if (const auto* line = std::get_if<LineSegment>(&a)) {
    const auto& other = std::get<LineSegment>(b);
    return line->start == other.start && line->end == other.end;
  }
  if (const auto* arc = std::get_if<CircularArc>(&a)) {
    const auto& other = std::get<CircularArc>(b);
    return arc->start == other.start && arc->end == other.end && arc->center == other.center &&
           arc->axis == other.axis && arc->radius == other.radius && arc->angle == other.angle;
  }
  if (const auto* arc = std::get_if<EllipticalArc>(&a)) {
    const auto& other = std::get<EllipticalArc>(b);
    return arc->start == other.start && arc->end == other.end && arc->center == other.center &&
           arc->axis == other.axis && arc->major == other.major && arc->ratio == other.ratio;
  }
  const auto &one = std::get<BSplineCurve>(a), &two = std::get<BSplineCurve>(b);
  return one.knots == two.knots && one.control_points == two.control_points && one.periodic == two.periodic;
}

double gap(const Contour& contour) {
  double worst = 0;
  for (std::size_t i = 0; i < contour.segments.size(); ++i) {
    const Segment& next = contour.segments[(i + 1) % contour.segments.size()];
    worst = std::max(worst, (evaluate(contour.segments[i].curve, 1) - evaluate(next.curve, 0)).norm());
  }
  return worst;
}

// A cylinder with a slanted top: its rims are circles and ellipses, in `walls` patches around.
Model slanted_cylinder(int walls) {
  Model model;
  Shell& shell = model.shells.emplace_back();
  shell.id = "cylinder";
  const int n = 48;
  for (const double slope : {0.0, 0.6}) {
    for (int i = 0; i < n; ++i) {
      const double t = 2 * kPi * i / n;
      shell.points.push_back(
          {5 * std::cos(t), 5 * std::sin(t), (slope > 0 ? 12 : 0) + slope * 5 * std::cos(t)});
    }
  }
  const auto add = [&](const std::vector<Triangle>& triangles) {
    shell.patches.push_back({"", {}, shell.triangles.size(), triangles.size()});
    shell.triangles.insert(shell.triangles.end(), triangles.begin(), triangles.end());
  };
  const auto low = [&](int i) { return static_cast<Index>(i % n); };
  const auto high = [&](int i) { return static_cast<Index>(n + i % n); };
  std::vector<Triangle> bottom, top;
  for (int i = 1; i + 1 < n; ++i) {
    bottom.push_back({low(0), low(i + 1), low(i)});
    top.push_back({high(0), high(i), high(i + 1)});
  }
  for (int w = 0; w < walls; ++w) {
    std::vector<Triangle> wall;
    for (int i = w * n / walls; i < (w + 1) * n / walls; ++i) {
      wall.push_back({low(i), low(i + 1), high(i + 1)});
      wall.push_back({low(i), high(i + 1), high(i)});
    }
    add(wall);
  }
  add(bottom);
  add(top);
  return model;
}

}  // namespace

TEST_CASE("fit_contours: the stud is circles, arcs and lines, as it was made", "[fit]") {
  const Fitted stud = fit(read_model(std::string(MESHCONTOUR_DATA_DIR) + "/stud.xml"));
  REQUIRE(stud.contours.size() == 14);
  for (const Contour& contour : stud.contours) {
    CAPTURE(contour.patch, contour.loop, kinds(contour));
    const bool disc = contour.patch == 0 || contour.patch == 3 || contour.patch == 12;
    if (!disc) {
      const std::string text = kinds(contour);
      CHECK((text == "ALAL" || text == "LALA"));
      continue;
    }
    REQUIRE(kinds(contour) == "C");
    const auto& circle = std::get<CircularArc>(contour.segments[0].curve);
    const BoundaryLoop& loop = stud.boundaries[0].patches[contour.patch].loops[contour.loop];
    const Point& first = stud.model.shells[0].points[loop.vertices[0]];
    CHECK(std::hypot(circle.center.x(), circle.center.y()) < 1e-9 * 90);
    CHECK(circle.center.z() == Approx(first.z()).margin(1e-9 * 90));
    CHECK(std::abs(circle.axis.z()) == Approx(1).epsilon(1e-9));
    CHECK(circle.radius == Approx(std::hypot(first.x(), first.y())).epsilon(1e-9));
  }
}

TEST_CASE("fit_contours: patches that share vertices share curves, bit for bit", "[fit]") {
  const int walls = GENERATE(1, 2, 3, 4);
  const Fitted fitted = fit(slanted_cylinder(walls));
  std::map<std::pair<Index, Index>, std::vector<const Segment*>> by_edges;
  for (const Contour& contour : fitted.contours) {
    CHECK(gap(contour) < 1e-12);
    for (const Segment& segment : contour.segments) {
      CHECK(segment.edge_count > 0);
      by_edges[{segment.edge, segment.edge_count}].push_back(&segment);
    }
  }
  for (const auto& [edges, segments] : by_edges) {
    CHECK(segments.size() <= 2);
    if (segments.size() < 2) continue;
    const bool turned = segments[0]->reversed != segments[1]->reversed;
    CHECK(turned);
    const Curve forward = segments[0]->reversed ? segments[1]->curve : segments[0]->curve;
    const Curve backward = segments[0]->reversed ? segments[0]->curve : segments[1]->curve;
    CHECK(same_bits(reversed(forward), backward));
  }
  CHECK(kinds(fitted.contours[fitted.contours.size() - 2]) == "C");
  CHECK(kinds(fitted.contours.back()) == "E");
}

TEST_CASE("fit_contours: each edge is written once when repeats are left out", "[fit]") {
  const int walls = GENERATE(1, 2, 3);
  const Fitted fitted = fit(slanted_cylinder(walls));
  const auto repeated = repeated_segments(fitted.contours);
  double written = 0;
  for (std::size_t c = 0; c < repeated.size(); ++c) {
    for (std::size_t i = 0; i < repeated[c].size(); ++i) {
      if (!repeated[c][i]) written += length(fitted.contours[c].segments[i].curve);
    }
  }
  double all = 0;
  for (const Contour& contour : fitted.contours) {
    for (const Segment& segment : contour.segments) all += length(segment.curve);
  }
  CHECK(written == Approx(all / 2).epsilon(1e-9));
}

TEST_CASE("fit_contours: the result does not depend on the threads", "[fit]") {
  const Model model = read_model(std::string(MESHCONTOUR_DATA_DIR) + "/stud.xml");
  const Fitted one = fit(model, primitives(1)), many = fit(model, primitives(4));
  REQUIRE(one.contours.size() == many.contours.size());
  for (std::size_t c = 0; c < one.contours.size(); ++c) {
    REQUIRE(one.contours[c].segments.size() == many.contours[c].segments.size());
    for (std::size_t i = 0; i < one.contours[c].segments.size(); ++i) {
      CHECK(same_bits(one.contours[c].segments[i].curve, many.contours[c].segments[i].curve));
    }
  }
}

TEST_CASE("fit_contours: a prism's sides stay lines, though their corners lie on a circle", "[fit]") {
  const Fitted fitted = fit(slanted_cylinder(48));
  for (const Contour& contour : fitted.contours)
    CHECK(kinds(contour).find_first_not_of('L') == std::string::npos);
}

TEST_CASE("fit_contours: a coarse gear has arcs of two chords and of one", "[fit]") {
  for (const shapes::Shape& shape : shapes::all()) {
    if (shape.name != "gear12") continue;
    const shapes::Loop loop = shapes::tessellate(shape, 1e-3 * shapes::size(shape), shapes::Steps::Uniform);
    REQUIRE(loop.points.size() == 60);
    const std::string text = kinds(fit_loop(loop.points).contours[0]);
    CHECK(std::count(text.begin(), text.end(), 'A') == 24);
    CHECK(std::count(text.begin(), text.end(), 'L') == 24);
  }
}

TEST_CASE("fit_contours: degenerate loops have defined contours", "[fit]") {
  const auto text = [](const std::vector<Point>& points) { return kinds(fit_loop(points).contours[0]); };
  const Point o(0, 0, 0), x(1, 0, 0), y(0, 1, 0);
  CHECK(text({o, x, y}) == "LLL");
  CHECK(text({o, {0.5, 0, 0}, x, {0.4, 0, 0}}) == "LL");
  CHECK(text({o, o, x, x, y, y}) == "LLL");
  CHECK(text({o, x, {0.5, 1e-7, 0}}) == "LL");
  std::vector<Point> pentagram, eight, trefoil, cardioid;
  for (int i = 0; i < 5; ++i) pentagram.push_back({std::cos(4 * kPi * i / 5), std::sin(4 * kPi * i / 5), 0});
  CHECK(text(pentagram) == "LLLLL");
  for (int i = 0; i < 120; ++i) {
    const double t = 2 * kPi * (i + 0.3) / 120;
    eight.push_back({std::sin(t), std::sin(2 * t), 0});
    trefoil.push_back(
        {std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), -std::sin(3 * t)});
    const double s = 2 * kPi * i / 120;
    cardioid.push_back({(1 - std::cos(s)) * std::cos(s), (1 - std::cos(s)) * std::sin(s), 0});
  }
  for (const auto& loop : {eight, trefoil}) {
    const Contour contour = fit_loop(loop).contours[0];
    REQUIRE(kinds(contour) == "S");
    CHECK(std::get<BSplineCurve>(contour.segments[0].curve).periodic);
  }
  CHECK(text(cardioid) == "S");
}

TEST_CASE("fit_contours: loops that cannot be fitted are their polygons and say so", "[fit]") {
  for (const double scale : {1e200, 1e-200, 0.0}) {
    const Fitted fitted = fit_loop({Point(0, 0, 0), scale * Point(1, 0, 0), scale * Point(0, 1, 0)});
    CHECK(fitted.contours[0].fallback);
    CHECK(fitted.diagnostics.size() == 1);
  }
}

TEST_CASE("fit_contours: the deviation of a contour is no smaller than what is measured", "[fit][property]") {
  for (const shapes::Shape& shape : shapes::all()) {
    const shapes::Loop loop = shapes::tessellate(shape, 1e-4 * shapes::size(shape), shapes::Steps::Adaptive);
    const Contour contour = fit_loop(loop.points).contours[0];
    CAPTURE(shape.name);
    const std::size_t n = loop.points.size();
    double measured = 0;
    for (const Segment& segment : contour.segments) {
      for (int k = 0; k <= 200; ++k) {
        const Point p = evaluate(segment.curve, k / 200.0);
        double best = 1e300;
        for (std::size_t i = 0; i < n; ++i) {
          const Point &a = loop.points[i], &b = loop.points[(i + 1) % n];
          const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
          best = std::min(best, (p - a - t * (b - a)).norm());
        }
        measured = std::max(measured, best);
      }
    }
    const bool polygon = kinds(contour).find_first_not_of('L') == std::string::npos;
    CHECK(contour.deviation >= (polygon ? measured - 1e-13 : measured));
  }
}

TEST_CASE("fit_contours: without primitives there are lines and B-splines only", "[fit]") {
  FitOptions options = primitives();
  options.method = FitMethod::Approximate;
  for (const shapes::Shape& shape : shapes::all()) {
    const shapes::Loop loop = shapes::tessellate(shape, 1e-4 * shapes::size(shape), shapes::Steps::Adaptive);
    std::vector<Diagnostic> diagnostics;
    const auto contours =
        fit_contours(shapes::model_of(loop.points), shapes::boundary_of(loop.points), options, diagnostics);
    CAPTURE(shape.name, kinds(contours[0]));
    CHECK(kinds(contours[0]).find_first_of("ACE") == std::string::npos);
    CHECK_FALSE(contours[0].fallback);
  }
}

// Contours of any loops: finite, joined, no farther from their own chords than they say, within the
// tolerance, and the same where patches share an edge.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "fit/arc_fit.hpp"
#include "fit/cleaning.hpp"
#include "fit/ellipse_fit.hpp"
#include "fuzz/fit_models.hpp"
#include "meshcontour/fit.hpp"
#include "model/segment_distance.hpp"

namespace fuzz {
namespace {

using namespace meshcontour;

constexpr int kSamples = 12;        // of a curve
constexpr double kRounding = 1e-9;  // of the largest coordinate

// One contour beside the loop that it was made of.
class ContourCheck {
 public:
  ContourCheck(const Contour& contour, const Shell& shell, const BoundaryLoop& loop, double tolerance)
      : contour_(contour), shell_(shell), loop_(loop) {
    Box box;
    for (const Index v : loop.vertices) box.extend(shell.points[v]);
    const double diagonal = box.diagonal().stableNorm();
    tolerance_ = tolerance > 0 ? tolerance : 1e-4 * diagonal;
    repeated_ = detail::kRepeatedPoint * diagonal;
    for (const Index v : loop.vertices) slack_ = std::max(slack_, shell.points[v].cwiseAbs().maxCoeff());
    slack_ *= kRounding;
  }

  void run() {
    require(!contour_.segments.empty(), "a contour without segments");
    require(contour_.closed == loop_.closed, "a contour that closes where its loop does not");
    require(std::isfinite(contour_.deviation) && contour_.deviation >= 0, "a deviation that is none");
    const std::size_t n = loop_.vertices.size(), first = position_of(contour_.segments[0].from, 0);
    std::size_t at = first;
    Point last = loop_.closed ? evaluate(contour_.segments.back().curve, 1) : point(first);
    for (const Segment& segment : contour_.segments) {
      require(segment.deviation <= contour_.deviation, "a segment farther off than its contour");
      at = passed_over(segment.from, at);
      const bool point = !loop_.closed && segment.from == segment.to;  // all that there is
      const std::size_t to = point ? n - 1 : position_of(segment.to, at + 1);
      check_segment(segment, at, to, last);
      last = evaluate(segment.curve, 1);
      at = to;
    }
    if (loop_.closed) at = passed_over(contour_.segments[0].from, at);
    require(at == first + (loop_.closed ? n : n - 1), "a contour that leaves a part of its loop out");
  }

 private:
  const Point& point(std::size_t position) const {
    return shell_.points[loop_.vertices[position % loop_.vertices.size()]];
  }

  // Where the vertex comes next in the loop.
  std::size_t position_of(Index vertex, std::size_t from) const {
    const std::size_t n = loop_.vertices.size();
    for (std::size_t steps = 0; steps <= n; ++steps) {
      if (loop_.vertices[(from + steps) % n] == vertex) return from + steps;
    }
    fail("a segment that ends outside its loop");
  }

  // The same; only repetitions of the point may lie between.
  std::size_t passed_over(Index vertex, std::size_t from) const {
    const std::size_t to = position_of(vertex, from);
    for (std::size_t i = from; i < to; ++i) {
      require((point(i) - point(to)).stableNorm() <= slack_, "chords without a curve");
    }
    return to;
  }

  void check_segment(const Segment& segment, std::size_t from, std::size_t to, const Point& last) const {
    require((evaluate(segment.curve, 0) - last).stableNorm() <= slack_, "segments that do not meet");
    const int samples = std::holds_alternative<LineSegment>(segment.curve) ? 3 : kSamples;
    for (int k = 0; k <= samples; ++k) {
      const Point p = evaluate(segment.curve, static_cast<double>(k) / samples);
      require(p.allFinite(), "a point that is not finite");
      require(distance_to_chords(p, from, to) <= segment.deviation * (1 + 1e-6) + slack_,
              "a curve farther from its chords than it says");
    }
    if (contour_.fallback) return;
    for (std::size_t i = from; i <= to; ++i) {
      require(distance_to_curve(segment.curve, point(i)) <= (tolerance_ + repeated_) * (1 + 1e-6) + slack_,
              "a vertex farther from its curve than allowed");
    }
  }

  double distance_to_chords(const Point& p, std::size_t from, std::size_t to) const {
    double least = (p - point(from)).stableNorm();
    for (std::size_t i = from; i < to; ++i) {
      least = std::min(least, detail::segment_distance(p, point(i), point(i + 1)));
    }
    return least;
  }

  // 0 for splines: only a search would tell.
  static double distance_to_curve(const Curve& curve, const Point& p) {
    if (const auto* line = std::get_if<LineSegment>(&curve)) {
      return detail::segment_distance(p, line->start, line->end);
    }
    if (const auto* arc = std::get_if<CircularArc>(&curve)) return detail::distance_to_circle(*arc, p);
    if (const auto* arc = std::get_if<EllipticalArc>(&curve)) return detail::distance_to_ellipse(*arc, p);
    return 0;
  }

  const Contour& contour_;
  const Shell& shell_;
  const BoundaryLoop& loop_;
  double tolerance_ = 0, slack_ = 0;
  double repeated_ = 0;  // points that near count as one
};

// Curves along the same edge are the same, but for rounding where they run the other way.
void check_edges(const std::vector<Contour>& contours, const Shell& shell) {
  double slack = 0;
  for (const Point& p : shell.points) slack = std::max(slack, kRounding * p.cwiseAbs().maxCoeff());
  std::map<std::pair<Index, bool>, std::array<Point, 3>> exact;
  std::map<Index, std::array<Point, 3>> known;
  for (const Contour& contour : contours) {
    for (const Segment& segment : contour.segments) {
      if (segment.edge_count != 1) continue;
      std::array<Point, 3> points;
      for (std::size_t k = 0; k < 3; ++k) {
        const double s = std::array{0.0, 0.375, 1.0}[k];
        points[k] = evaluate(segment.curve, segment.reversed ? 1 - s : s);
      }
      const auto& same = exact.emplace(std::pair{segment.edge, segment.reversed}, points).first->second;
      const auto& first = known.emplace(segment.edge, points).first->second;
      for (std::size_t k = 0; k < 3; ++k) {
        const double off = (points[k] - first[k]).stableNorm();
        require(points[k] == same[k] && off <= slack, "two curves along one edge");
      }
    }
  }
}

FitOptions options_of(Source& source, const Shell& shell) {
  const std::uint8_t choice = source.byte();
  FitOptions options;
  options.method = choice % 16 < 10 ? FitMethod::Primitives : static_cast<FitMethod>(choice % 4);
  options.threads = 1;
  constexpr std::array kShares = {0.0, 0.0, 0.0, 1e-2, 1e-6, 1e-12, 1e-3, 10.0};
  Box box;
  for (const Point& p : shell.points) box.extend(p);
  const double diagonal = box.diagonal().stableNorm();
  if (diagonal > 0) options.tolerance = kShares[choice / 16 % 8] * diagonal;
  if (choice & 128) options.corner_angle = (1 + source.byte() % 180) * std::numbers::pi / 180;
  return options;
}

}  // namespace

void fit_loop(Bytes input) {
  Source source(input);
  Source for_options = source;
  source.word();
  const FitModel fitted = fit_model_of(source);
  const Shell& shell = fitted.model.shells[0];
  if (shell.points.empty()) return;
  std::vector<Diagnostic> diagnostics;
  const FitOptions options = options_of(for_options, shell);
  const auto contours = fit_contours(fitted.model, fitted.boundaries, options, diagnostics);
  auto contour = contours.begin();
  for (const PatchBoundary& patch : fitted.boundaries[0].patches) {
    for (const BoundaryLoop& loop : patch.loops) {
      require(contour != contours.end(), "fewer contours than loops");
      ContourCheck(*contour++, shell, loop, options.tolerance).run();
    }
  }
  require(contour == contours.end(), "more contours than loops");
  check_edges(contours, shell);
}

}  // namespace fuzz

#include "fit/free_form.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "fit/arc_fit.hpp"
#include "fit/ellipse_fit.hpp"

namespace meshcontour::detail {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kNoise = 0.1;       // of the tolerance
constexpr double kStraight = 0.01;   // of the tolerance: how far points of a line may be off it
constexpr int kSplineAttempts = 40;  // of one part; what is then left is its polygon

double angle_between(const Vector& a, const Vector& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// The tangent at points[0] of the circle through three points: the first chord, turned back by the angle at
// the third point.
Vector circle_tangent(const Point& at, const Point& near, const Point& far) {
  const Vector chord = (near - at).normalized();
  const double angle = angle_between(near - far, at - far);
  const Vector axis = (near - at).cross(far - near);
  if (!(axis.norm() > 0)) return chord;
  return Eigen::AngleAxisd(-angle, axis.normalized()) * chord;
}

// The smallest angle between one-sided tangents at the vertex, by chords and by circles.
double tangent_jump(const Path& path, std::size_t vertex) {
  const Point& here = path.points[vertex];
  const Point *before = path.beyond(vertex, -1), *after = path.beyond(vertex, 1);
  const Point *far_before = path.beyond(vertex, -2), *far_after = path.beyond(vertex, 2);
  if (!before || !after) return 0;
  std::vector<Vector> in = {here - *before}, out = {*after - here};
  if (far_before) in.push_back(-circle_tangent(here, *before, *far_before));
  if (far_after) out.push_back(circle_tangent(here, *after, *far_after));
  double jump = std::numbers::pi;
  for (const Vector& a : in) {
    for (const Vector& b : out) jump = std::min(jump, angle_between(a, b));
  }
  return jump;
}

bool is_soft_corner(const Path& path, std::size_t vertex, const RecognitionOptions& options) {
  const double turn = path.turn[vertex];
  const std::size_t n = path.chords();
  if (turn <= 4 * kDegree) return false;
  if (options.bounded &&
      !(options.evidence && options.evidence->known() && turn > 1.2 * options.evidence->angle)) {
    return false;
  }
  const auto turn_at = [&](std::size_t i) {
    return i == 0 || i >= n ? (path.closed ? path.turn[0] : 0) : path.turn[i];
  };
  if (turn <= 2.5 * std::max(turn_at(vertex - 1), turn_at(vertex + 1))) return false;
  return tangent_jump(path, vertex) > std::max(4 * kDegree, turn / 2);
}

// Works through one part, a stretch at a time.
class FreeFormSplitter {
 public:
  FreeFormSplitter(const Path& path, const Run& run, double eps, const RecognitionOptions& options,
                   SplineCache& splines)
      : path_(path), run_(run), eps_(eps), options_(options), splines_(splines) {}

  std::vector<Piece> split(const Run& part) {
    ring_ = part;
    stack_ = {{part.begin, part.end}};
    while (!stack_.empty()) {
      const auto [begin, end] = stack_.back();
      stack_.pop_back();
      take(begin, end);
    }
    return std::move(done_);
  }

 private:
  bool is_ring(std::size_t begin, std::size_t end) const {
    return !ring_.ends_hard && begin == ring_.begin && end == ring_.end;
  }

  void take(std::size_t begin, std::size_t end) {
    if (end - begin == 1) return add_line(begin, end, true);
    const double straight = std::max(eps_, kStraight * options_.tolerance);
    if (const std::optional<double> residual = line_residual(path_.run(begin, end), straight)) {
      add_line(begin, end, true);
      done_.back().residual = *residual;
      return;
    }
    if (end - begin == 2) return take_two(begin);
    if (options_.primitives && !is_ring(begin, end)) {
      if (std::optional<Piece> conic = as_conic(begin, end)) return done_.push_back(std::move(*conic));
    }
    if (split_at_corners(begin, end)) return;
    take_spline(begin, end);
  }

  void add_line(std::size_t begin, std::size_t end, bool certain) {
    done_.push_back(line_piece(path_, begin, end));
    done_.back().recognized = certain;
  }

  void add_polygon(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) add_line(i, i + 1, false);
  }

  void take_two(std::size_t begin) {
    if (options_.primitives) {
      if (std::optional<Piece> arc = two_chord_arc(path_, run_, begin, eps_, options_)) {
        return done_.push_back(std::move(*arc));
      }
    }
    const bool whole = begin == run_.begin && begin + 2 == run_.end;
    if (is_coarse_corner(path_, begin + 1, options_) || !(options_.bounded && whole))
      return add_polygon(begin, begin + 2);
    take_spline(begin, begin + 2);
  }

  // The whole stretch as one arc or ellipse. Above kNoise of the tolerance only where no patch corners bound
  // the chain: there a curve that is nearly an arc is more likely an edge of its own kind than a noisy arc.
  std::optional<Piece> as_conic(std::size_t begin, std::size_t end) const {
    if (options_.bounded && eps_ > kNoise * options_.tolerance) return std::nullopt;
    const std::span<const Point> points = path_.run(begin, end);
    if (const std::optional<ArcFit> fit = fit_arc(points, eps_)) {
      const double sagitta = fit->arc.radius * (1 - std::cos(fit->arc.angle / 2));
      const double shortest = *std::min_element(path_.length.begin() + static_cast<std::ptrdiff_t>(begin),
                                                path_.length.begin() + static_cast<std::ptrdiff_t>(end));
      const double slack = 8 * eps_ / shortest;
      const double uneven = unevenness(path_, begin, end);
      const bool even = slack < 0.05 && uneven <= 1e-3 + slack;
      const bool deep = points.size() >= 7
                            ? sagitta > 50 * fit->residual
                            : sagitta > 10 * eps_ && uneven < 0.05 + slack && !options_.bounded;
      if (even || deep) return Piece{begin, end, fit->arc, fit->residual, true};
    }
    if (points.size() < 9) return std::nullopt;
    const std::optional<EllipseFit> fit = fit_ellipse(points, false, eps_);
    if (!fit) return std::nullopt;
    return Piece{begin, end, fit->arc, fit->residual, true};
  }

  bool split_at_corners(std::size_t begin, std::size_t end) {
    std::vector<std::size_t> joints = {begin};
    for (std::size_t i = begin + 1; i < end; ++i) {
      if (is_coarse_corner(path_, i, options_) || is_soft_corner(path_, i, options_)) joints.push_back(i);
    }
    if (joints.size() == 1) return false;
    joints.push_back(end);
    for (std::size_t i = joints.size() - 1; i > 0; --i) stack_.push_back({joints[i - 1], joints[i]});
    return true;
  }

  void take_spline(std::size_t begin, std::size_t end) {
    if (++attempts_ > kSplineAttempts) return add_polygon(begin, end);
    const bool ring = is_ring(begin, end);
    const SplineRun& spline = splines_.run(path_, begin, end, ring);
    if (!spline.accepted) return split_at_chord(begin, end, begin + spline.worst_chord);
    if (!ring && is_better_with_line(begin, end))
      return split_at_chord(begin, end, longest_chord(begin, end));
    done_.push_back({begin, end, spline.curve, spline.vertex_error, false, spline.deviation});
  }

  void split_at_chord(std::size_t begin, std::size_t end, std::size_t chord) {
    chord = std::clamp(chord, begin, end - 1);
    if (chord + 1 < end) stack_.push_back({chord + 1, end});
    stack_.push_back({chord, chord + 1});
    if (chord > begin) stack_.push_back({begin, chord});
  }

  std::size_t longest_chord(std::size_t begin, std::size_t end) const {
    const auto first = path_.length.begin();
    return static_cast<std::size_t>(std::max_element(first + static_cast<std::ptrdiff_t>(begin),
                                                     first + static_cast<std::ptrdiff_t>(end)) -
                                    first);
  }

  double spline_cost(std::size_t begin, std::size_t end) {
    if (end == begin) return 0;
    if (end - begin == 1) return 4;
    const SplineRun& spline = splines_.run(path_, begin, end, false);
    return description_cost({Piece{begin, end, spline.curve, 0, false}}) + (spline.accepted ? 0 : 100);
  }

  // Whether the longest chord as a line of its own makes the description shorter.
  bool is_better_with_line(std::size_t begin, std::size_t end) {
    const std::size_t chord = longest_chord(begin, end);
    double beside = 0;
    if (chord > begin) beside = std::max(beside, path_.length[chord - 1]);
    if (chord + 1 < end) beside = std::max(beside, path_.length[chord + 1]);
    if (!(path_.length[chord] > 1.8 * beside)) return false;
    const double joint = options_.bounded ? 6 : 0;  // between patch corners one edge is likelier than two
    return 4 + joint + spline_cost(begin, chord) + spline_cost(chord + 1, end) < spline_cost(begin, end);
  }

  const Path& path_;
  const Run& run_;
  double eps_;
  const RecognitionOptions& options_;
  SplineCache& splines_;
  Run ring_;
  int attempts_ = 0;
  std::vector<std::pair<std::size_t, std::size_t>> stack_;  // the leftmost stretch on top
  std::vector<Piece> done_;
};

}  // namespace

std::vector<Piece> split_free_form(const Path& path, const Run& run, const Run& part, double eps,
                                   const RecognitionOptions& options, SplineCache& splines) {
  return FreeFormSplitter(path, run, eps, options, splines).split(part);
}

}  // namespace meshcontour::detail

#include "fit/recognition.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "fit/arc_fit.hpp"
#include "fit/ellipse_fit.hpp"
#include "fit/evidence.hpp"
#include "fit/free_form.hpp"

namespace meshcontour::detail {

namespace {

constexpr double kLadder[] = {1e-5, 1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.3, 1};
constexpr std::size_t kEllipsePoints = 9;
constexpr double kTight = 1e-3;  // share of the tolerance at which a match is no accident

// Joints of a CAD model may be this far off the curves that meet there, while the points between are exact;
// share of the tolerance.
constexpr double kJointError = 0.1;

// One description of the path.
struct Attempt {
  Recognition result;
  double cost = std::numeric_limits<double>::infinity();
  bool certain = false;  // every piece recognized
  bool simple = false;   // one piece between hard corners: looser tolerances cannot do better
};

class Recognizer {
 public:
  Recognizer(Path path, const RecognitionOptions& options)
      : path_(std::move(path)), options_(options), splines_(options.tolerance) {}

  Recognition run() {
    if (path_.chords() == 0) return {std::move(path_), {}};
    start_at_hard_corner();
    std::vector<Attempt> attempts;
    double cheapest = std::numeric_limits<double>::infinity();
    for (const double eps : ladder()) {
      Attempt attempt = at_tolerance(eps);
      cheapest = std::min(cheapest, attempt.cost);
      attempts.push_back(std::move(attempt));
      if (attempts.back().certain && (attempts.back().simple || eps >= kJointError * options_.tolerance))
        break;
    }
    for (Attempt& attempt : attempts) {
      if (attempt.cost <= 1.15 * cheapest) return std::move(attempt.result);
    }
    return std::move(attempts.back().result);
  }

 private:
  bool is_hard(std::size_t vertex) const { return path_.turn[vertex] > options_.corner_angle; }

  // Makes a hard corner of a closed path its first point; a ring is one without.
  void start_at_hard_corner() {
    ring_ = path_.closed;
    for (std::size_t i = 0; i < path_.chords() && ring_; ++i) {
      if (!is_hard(i)) continue;
      if (i > 0) path_ = rotated(path_, i);
      ring_ = false;
    }
  }

  std::vector<double> ladder() const {
    const double top = std::min(options_.tolerance, 1e-2 * path_.extent);
    const double magnitude = path_.origin.cwiseAbs().maxCoeff() + path_.extent;
    const double floor = std::max({options_.noise, 1e-10 * path_.extent, 8e-16 * magnitude});
    std::vector<double> rungs;
    for (const double share : kLadder) {
      const double eps = std::min(std::max(share * top, floor), options_.tolerance);
      if (rungs.empty() || eps > rungs.back()) rungs.push_back(eps);
    }
    return rungs;
  }

  Attempt at_tolerance(double eps) {
    if (!ring_) return finish(path_, whole(path_, true), eps);
    if (std::optional<Attempt> conic = as_closed_conic(eps)) return std::move(*conic);
    Path turned = rotated(path_, after_longest_chord());
    for (int pass = 0; pass < 2; ++pass) {
      const Run run = whole(turned, false);
      const std::vector<Piece> pieces = judged(turned, run, eps);
      const auto largest = std::max_element(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
        return (a.recognized ? a.chords() : 0) < (b.recognized ? b.chords() : 0);
      });
      if (!largest->recognized) return as_free_ring(turned, eps);
      if (largest->begin == 0) break;
      turned = rotated(turned, largest->begin);
    }
    return finish(turned, whole(turned, false), eps);
  }

  static Run whole(const Path& path, bool ends_hard) { return {0, path.chords(), ends_hard}; }

  std::size_t after_longest_chord() const {
    const auto longest = std::max_element(path_.length.begin(), path_.length.end());
    return (static_cast<std::size_t>(longest - path_.length.begin()) + 1) % path_.chords();
  }

  std::optional<Attempt> as_closed_conic(double eps) const {
    if (!options_.primitives || path_.chords() < 5) return std::nullopt;
    const std::span<const Point> points = path_.run(0, path_.chords() - 1);
    Attempt attempt;
    attempt.certain = attempt.simple = true;
    Piece piece{0, path_.chords(), LineSegment{}, 0, true};
    if (const std::optional<ArcFit> circle = fit_circle(points, eps)) {
      piece.curve = circle->arc;
      piece.residual = circle->residual;
    } else {
      if (points.size() < kEllipsePoints) return std::nullopt;
      const std::optional<EllipseFit> ellipse = fit_ellipse(points, true, eps);
      if (!ellipse) return std::nullopt;
      piece.curve = ellipse->arc;
      piece.residual = ellipse->residual;
    }
    attempt.result = {path_, {piece}};
    attempt.cost = description_cost(attempt.result.pieces);
    return attempt;
  }

  // A ring without any recognized piece: one periodic curve, or an open one from a soft corner back to it.
  Attempt as_free_ring(Path& turned, double eps) {
    const std::size_t n = turned.chords();
    for (std::size_t i = 0; i < n; ++i) {
      if (i > 0 && is_coarse_corner(turned, i, options_)) {
        turned = rotated(turned, i);
        return finish(turned, whole(turned, true), eps);
      }
    }
    const Run run = whole(turned, false);
    return made(turned, split_free_form(turned, run, run, eps, options_, splines_));
  }

  std::vector<Piece> judged(const Path& path, const Run& run, double eps) const {
    std::vector<Piece> pieces = grow_pieces(path, run.begin, run.end, eps, options_.primitives);
    judge_pieces(path, run, pieces, eps, options_);
    return pieces;
  }

  // The runs between hard corners: recognized pieces stay, what lies between them is free form.
  Attempt finish(const Path& path, const Run& all, double eps) {
    std::vector<Piece> done;
    for (std::size_t begin = all.begin; begin < all.end;) {
      std::size_t end = begin + 1;
      while (end < all.end && path.turn[end] <= options_.corner_angle) ++end;
      const Run run{begin, end, all.ends_hard || begin > all.begin || end < all.end};
      add_run(path, run, eps, done);
      begin = end;
    }
    Attempt attempt = made(path, std::move(done));
    std::size_t runs = 1;
    for (std::size_t i = 1; i < path.chords(); ++i) runs += path.turn[i] > options_.corner_angle;
    attempt.simple = attempt.result.pieces.size() == runs;
    if (options_.bounded) {  // one edge between patch corners is likelier than several
      const double joint = eps <= kTight * options_.tolerance ? 3 : 10;
      attempt.cost += joint * static_cast<double>(attempt.result.pieces.size() - runs);
    }
    return attempt;
  }

  void add_run(const Path& path, const Run& run, double eps, std::vector<Piece>& done) {
    const std::vector<Piece> pieces = judged(path, run, eps);
    for (std::size_t k = 0; k < pieces.size();) {
      if (pieces[k].recognized) {
        done.push_back(pieces[k++]);
        continue;
      }
      std::size_t last = k;
      while (last + 1 < pieces.size() && !pieces[last + 1].recognized) ++last;
      const Run part{pieces[k].begin, pieces[last].end, true};
      std::vector<Piece> split = split_free_form(path, run, part, eps, options_, splines_);
      std::move(split.begin(), split.end(), std::back_inserter(done));
      k = last + 1;
    }
  }

  static Attempt made(const Path& path, std::vector<Piece> pieces) {
    Attempt attempt;
    attempt.cost = description_cost(pieces);
    attempt.certain = std::all_of(pieces.begin(), pieces.end(), [](const Piece& p) { return p.recognized; });
    attempt.result = {path, std::move(pieces)};
    return attempt;
  }

  Path path_;
  const RecognitionOptions& options_;
  SplineCache splines_;
  bool ring_ = false;
};

}  // namespace

const SplineRun& SplineCache::run(const Path& path, std::size_t begin, std::size_t end, bool ring) {
  const auto key = std::make_tuple(path.source[begin], path.source[end], ring);
  const auto known = runs_.find(key);
  if (known != runs_.end()) return known->second;
  SplineRunOptions options;
  options.tolerance = tolerance_;
  options.closed = ring;
  return runs_.emplace(key, fit_spline_run(path.run(begin, ring ? end - 1 : end), options)).first->second;
}

double description_cost(const std::vector<Piece>& pieces) {
  double cost = 0;
  for (const Piece& piece : pieces) {
    if (piece.is_line()) {
      cost += piece.recognized ? 4 : 5;
    } else if (const auto* arc = std::get_if<CircularArc>(&piece.curve)) {
      cost += arc->full() ? 8 : 7;
    } else if (std::holds_alternative<EllipticalArc>(piece.curve)) {
      cost += 10;
    } else {
      const auto& spline = std::get<BSplineCurve>(piece.curve);
      const double points = static_cast<double>(spline.control_points.size()) - (spline.periodic ? 3 : 0);
      cost += 3 * points + std::max(0.0, points - 4) + 1;  // coordinates and inner knots
    }
  }
  return cost;
}

Recognition recognize(Path path, const RecognitionOptions& options) {
  return Recognizer(std::move(path), options).run();
}

}  // namespace meshcontour::detail

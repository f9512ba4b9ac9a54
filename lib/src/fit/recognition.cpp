#include "fit/recognition.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "fit/closed_conic_fit.hpp"
#include "fit/evidence.hpp"
#include "fit/free_form.hpp"
#include "fit/loop.hpp"
#include "fit/small_arcs.hpp"

namespace meshcontour::detail {

namespace {

constexpr double kLadder[] = {1e-5, 1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.3, 1};
constexpr std::size_t kEllipsePoints = 9;
constexpr std::size_t kFewChords = 3;  // so few may be an arc when the model has others like it
constexpr double kSlack = 2.5;         // less than an arc costs beyond the control point that it saves
constexpr double kTight = 1e-3;        // share of the tolerance at which a match is no accident

// Joints of a CAD model may be this far off the curves that meet there, while the points between are exact;
// share of the tolerance.
constexpr double kJointError = 0.1;

// One description of a run or ring.
struct Attempt {
  std::size_t start = 0;  // of a ring: the point of the path that the pieces count from
  std::vector<Piece> pieces;
  double cost = std::numeric_limits<double>::infinity();
  bool certain = false;  // every piece recognized
};

class Recognizer {
 public:
  Recognizer(Path path, const RecognitionOptions& options)
      : path_(std::move(path)), options_(options), splines_(options.tolerance) {}

  Recognition run() {
    if (path_.chords() == 0) return {std::move(path_), {}};
    if (!is_usable_size(path_.extent)) return polygon();
    std::size_t corner = 0;
    while (path_.closed && corner < path_.chords() && !is_hard(corner)) ++corner;
    if (path_.closed && corner == path_.chords()) return recognize_ring();
    if (corner > 0) path_ = rotated(path_, corner);
    std::vector<Piece> pieces;
    for (std::size_t begin = 0; begin < path_.chords();) {
      std::size_t end = begin + 1;
      while (end < path_.chords() && !is_hard(end)) ++end;
      const Run run{begin, end, true};
      Attempt best = end - begin == 1
                         ? single_chord(begin)
                         : best_of_ladder([&](double eps) { return at_tolerance(path_, run, eps); });
      std::move(best.pieces.begin(), best.pieces.end(), std::back_inserter(pieces));
      begin = end;
    }
    return {std::move(path_), std::move(pieces)};
  }

 private:
  // Of a chain whose lengths have no squares.
  Recognition polygon() {
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < path_.chords(); ++i) pieces.push_back(line_piece(path_, i, i + 1));
    return {std::move(path_), std::move(pieces)};
  }

  bool is_hard(std::size_t vertex) const { return path_.turn[vertex] > options_.corner_angle; }

  // A line, unless the shell has arcs of one chord and this is one of them.
  Attempt single_chord(std::size_t begin) const {
    Piece piece = line_piece(path_, begin, begin + 1);
    piece.recognized = true;
    if (options_.evidence) {
      const Point start = path_.points[begin] + path_.origin, end = path_.points[begin + 1] + path_.origin;
      for (CircularArc circle : options_.evidence->shells[options_.shell].chords) {
        if (!is_chord_of(start, end, circle, 1e-4 * circle.radius)) continue;
        circle.center -= path_.origin;
        piece.curve = arc_over_chord(path_.points[begin], path_.points[begin + 1], circle);
        break;
      }
    }
    return made({piece});
  }

  Recognition recognize_ring() {
    Attempt best = best_of_ladder([&](double eps) { return ring_at_tolerance(eps); });
    if (best.start > 0) path_ = rotated(path_, best.start);
    return {std::move(path_), std::move(best.pieces)};
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

  // The description at the tightest tolerance that is hardly longer than the shortest. Once every piece is
  // recognized, looser tolerances are tried only as far as joints may be off, and not at all for a single
  // piece.
  template <class AtTolerance>
  Attempt best_of_ladder(AtTolerance at) {
    std::vector<Attempt> attempts;
    double cheapest = std::numeric_limits<double>::infinity(), certain_at = 0;
    for (const double eps : ladder()) {
      attempts.push_back(at(eps));
      const Attempt& last = attempts.back();
      cheapest = std::min(cheapest, last.cost);
      if (!last.certain) continue;
      if (certain_at == 0) certain_at = eps;
      if (last.pieces.size() == 1 || eps >= std::max(kJointError * options_.tolerance, 4 * certain_at)) break;
    }
    const double enough = cheapest + std::min(0.15 * cheapest, kSlack);
    const auto best =
        std::find_if(attempts.begin(), attempts.end(), [&](const Attempt& a) { return a.cost <= enough; });
    return std::move(*best);
  }

  Attempt ring_at_tolerance(double eps) {
    if (std::optional<Attempt> conic = as_closed_conic(eps)) return std::move(*conic);
    std::size_t start = after_longest_chord();
    Path turned = rotated(path_, start);
    for (int pass = 0; pass < 2; ++pass) {
      const std::vector<Piece> pieces = judged(turned, {0, turned.chords(), false}, eps);
      const auto largest = std::max_element(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
        return (a.recognized ? a.chords() : 0) < (b.recognized ? b.chords() : 0);
      });
      if (!largest->recognized) return free_ring(turned, start, eps);
      if (largest->begin == 0) break;
      start = (start + largest->begin) % turned.chords();
      turned = rotated(path_, start);
    }
    Attempt attempt = at_tolerance(turned, {0, turned.chords(), false}, eps);
    attempt.start = start;
    return attempt;
  }

  std::size_t after_longest_chord() const {
    const auto longest = std::max_element(path_.length.begin(), path_.length.end());
    return (static_cast<std::size_t>(longest - path_.length.begin()) + 1) % path_.chords();
  }

  std::optional<Attempt> as_closed_conic(double eps) const {
    if (!options_.primitives || path_.chords() < 5) return std::nullopt;
    const std::span<const Point> points = path_.run(0, path_.chords() - 1);
    Piece piece{0, path_.chords(), LineSegment{}, 0, true};
    const std::optional<ConicFit> conic = fit_closed_conic(points, eps, options_.tolerance, kEllipsePoints);
    if (!conic) return std::nullopt;
    piece.curve = conic->curve;
    piece.residual = conic->residual;
    return made({piece});
  }

  // A ring without any recognized piece: one periodic curve, or open ones from a corner back to it.
  Attempt free_ring(const Path& turned, std::size_t start, double eps) {
    const std::size_t n = turned.chords();
    for (std::size_t i = 1; i < n; ++i) {
      if (!is_coarse_corner(turned, i, options_)) continue;
      Attempt attempt = at_tolerance(rotated(turned, i), {0, n, true}, eps);
      attempt.start = (start + i) % n;
      return attempt;
    }
    const Run ring{0, n, false};
    Attempt attempt = made(split_free_form(turned, ring, ring, eps, options_, splines_));
    attempt.start = start;
    return attempt;
  }

  std::vector<Piece> judged(const Path& path, const Run& run, double eps) const {
    const GrowLimits limits{eps, std::min(2 * eps, options_.tolerance), options_.primitives};
    std::vector<Piece> pieces = grow_pieces(path, run.begin, run.end, limits);
    judge_pieces(path, run, pieces, eps, options_);
    return pieces;
  }

  // Recognized pieces stay, what lies between them is free form.
  Attempt at_tolerance(const Path& path, const Run& run, double eps) {
    const std::vector<Piece> pieces = judged(path, run, eps);
    std::vector<Piece> done;
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
    Attempt attempt = made(std::move(done));
    if (options_.bounded) {  // one edge between patch corners is likelier than several
      const double joint = eps <= kTight * options_.tolerance ? 3 : 10;
      attempt.cost += joint * static_cast<double>(attempt.pieces.size() - 1);
    }
    return attempt;
  }

  static Attempt made(std::vector<Piece> pieces) {
    Attempt attempt;
    attempt.cost = description_cost(pieces);
    attempt.certain = std::all_of(pieces.begin(), pieces.end(), [](const Piece& p) { return p.recognized; });
    attempt.pieces = std::move(pieces);
    return attempt;
  }

  Path path_;
  const RecognitionOptions& options_;
  SplineCache splines_;
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

bool may_change(const Recognition& fit, const RecognitionOptions& options) {
  if (!options.evidence->shells[options.shell].chords.empty()) return true;
  const Path& path = fit.path;
  for (const Piece& piece : fit.pieces) {
    if (piece.recognized) continue;
    if (piece.is_line() || piece.chords() <= kFewChords) return true;
    const Run run{piece.begin, piece.end, true};
    for (std::size_t i = piece.begin; i < piece.end; ++i) {
      if (is_long_chord(path, run, i, options)) return true;
      if (i > piece.begin && path.turn[i] > options.evidence->angle) return true;
    }
  }
  return false;
}

}  // namespace meshcontour::detail

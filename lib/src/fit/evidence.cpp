#include "fit/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "fit/arc_fit.hpp"

namespace meshcontour::detail {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::size_t kManyChords = 64;
constexpr double kTangent = 0.02 * std::numbers::pi / 180;

double angle_between(const Vector& a, const Vector& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double distance_to(const Piece& piece, const Point& p) {
  if (piece.is_arc()) return distance_to_circle(std::get<CircularArc>(piece.curve), p);
  const auto& line = std::get<LineSegment>(piece.curve);
  const Vector along = (line.end - line.start).normalized(), v = p - line.start;
  return (v - v.dot(along) * along).norm();
}

double shortest_chord(const Path& path, const Piece& piece) {
  return *std::min_element(path.length.begin() + static_cast<std::ptrdiff_t>(piece.begin),
                           path.length.begin() + static_cast<std::ptrdiff_t>(piece.end));
}

// Judges the pieces of one run at one tolerance.
class Judge {
 public:
  Judge(const Path& path, const Run& run, std::vector<Piece>& pieces, double eps,
        const RecognitionOptions& options)
      : path_(path), run_(run), pieces_(pieces), eps_(eps), options_(options) {}

  void judge() {
    for (Piece& piece : pieces_) {
      if (piece.chords() >= 4 && piece.is_arc()) piece.recognized = is_long_arc(piece);
      if (piece.chords() >= 3 && piece.is_line()) {
        piece.recognized = off_beyond(piece) >= 20 * noise(piece) || ends_far_off(piece);
      }
    }
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      if (pieces_[k].chords() == 3 && pieces_[k].is_arc()) pieces_[k].recognized = is_three_chord_arc(k);
    }
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      Piece& piece = pieces_[k];
      if (!piece.is_line() || piece.recognized) continue;
      piece.recognized = piece.chords() == 1 ? is_single_line(k) : solid(k, false) && solid(k, true);
    }
    for (std::size_t k = 0; k < pieces_.size(); ++k) {  // what is left alone between solid pieces
      Piece& piece = pieces_[k];
      if (piece.is_line() && piece.chords() == 1 && solid(k, false) && solid(k, true))
        piece.recognized = true;
    }
  }

 private:
  double noise(const Piece& piece) const { return std::max(piece.residual, 0.1 * eps_); }

  bool even(const Piece& piece) const {
    const double slack = 8 * eps_ / shortest_chord(path_, piece);
    return slack < 0.05 && unevenness(path_, piece.begin, piece.end) <= 1e-3 + slack;
  }

  bool hard(const Piece& piece, bool at_end) const {
    return run_.ends_hard && (at_end ? piece.end == run_.end : piece.begin == run_.begin);
  }

  // Distance of the vertices `steps` beyond the ends to the piece's line or circle, at most to the run's own
  // ends; infinite if there are none.
  double off_beyond(const Piece& piece, std::size_t steps = 1) const {
    double nearest = kNever;
    for (const bool at_end : {false, true}) {
      if (hard(piece, at_end)) continue;
      std::size_t reach = steps;
      if (run_.ends_hard) reach = std::min(reach, at_end ? run_.end - piece.end : piece.begin - run_.begin);
      const auto signed_reach = static_cast<std::ptrdiff_t>(reach);
      const Point* next =
          path_.beyond(at_end ? piece.end : piece.begin, at_end ? signed_reach : -signed_reach);
      if (next) nearest = std::min(nearest, distance_to(piece, *next));
    }
    return nearest;
  }

  // White noise changes sign from vertex to vertex; the residual of a curve that is no arc is a smooth wave.
  bool noise_like(const Piece& piece) const {
    const auto& arc = std::get<CircularArc>(piece.curve);
    double sum = 0, steps = 0, before = 0;
    for (std::size_t i = piece.begin + 1; i < piece.end; ++i) {
      const Vector v = path_.points[i] - arc.center;
      const double off = (v - v.dot(arc.axis) * arc.axis).norm() - arc.radius;
      sum += off * off;
      if (i > piece.begin + 1) steps += (off - before) * (off - before);
      before = off;
    }
    return steps > 0.8 * sum;
  }

  // Where chords are short, the first vertices beyond a joint are hardly off, those a quarter of the piece
  // away are: by 100 times what the points are off the piece. Pieces of smooth curves that only look like
  // arcs or lines leave it by 5 to 25 times that much.
  bool ends_far_off(const Piece& piece) const {
    return piece.chords() >= kManyChords && off_beyond(piece, piece.chords() / 4) >= 100 * noise(piece);
  }

  bool is_long_arc(const Piece& piece) const {
    const auto& arc = std::get<CircularArc>(piece.curve);
    const bool steps = even(piece);
    const double sagitta = arc.radius * (1 - std::cos(arc.angle / 2));
    if (!steps && sagitta < 30 * piece.residual) return false;
    const double off = off_beyond(piece);
    double factor = piece.chords() < 8 ? 20 : 10;
    if (steps) factor /= 3;
    if (off >= factor * noise(piece)) return true;
    if (ends_far_off(piece)) return true;
    // Noise hides the first vertices beyond a joint, not those a quarter of the arc away.
    return piece.chords() >= 12 && noise_like(piece) &&
           off_beyond(piece, piece.chords() / 4) >= 20 * noise(piece);
  }

  const Piece* neighbour(std::size_t k, bool at_end) const {
    if (hard(pieces_[k], at_end)) return nullptr;
    const std::size_t count = pieces_.size();
    return &pieces_[(k + (at_end ? 1 : count - 1)) % count];
  }

  bool solid(std::size_t k, bool at_end) const {
    const Piece* other = neighbour(k, at_end);
    return !other || other->recognized;
  }

  // How far the tangents of two pieces may differ by the points' own errors.
  double tangent_slack(const Piece& a, const Piece& b) const {
    return kTangent + 4 * eps_ * (1 / shortest_chord(path_, a) + 1 / shortest_chord(path_, b));
  }

  bool tangent(const Piece& piece, const Piece& other, bool at_end) const {
    return angle_between(tangent_of(piece, at_end), tangent_of(other, !at_end)) < tangent_slack(piece, other);
  }

  bool is_three_chord_arc(std::size_t k) const {
    const Piece& piece = pieces_[k];
    if (!even(piece)) return false;
    if (off_beyond(piece) < 20 * noise(piece)) return false;
    for (const bool at_end : {false, true}) {
      const Piece* other = neighbour(k, at_end);
      if (!other) continue;
      const bool straight = other->is_line() || other->recognized;
      if (!straight || !tangent(piece, *other, at_end)) return false;
    }
    return true;
  }

  bool is_single_line(std::size_t k) const {
    const Piece& piece = pieces_[k];
    for (const bool at_end : {false, true}) {
      const Piece* other = neighbour(k, at_end);
      if (other && other->recognized && other->is_arc() && tangent(piece, *other, at_end)) return true;
    }
    return is_long_chord(path_, run_, piece.begin, options_);
  }

  const Path& path_;
  const Run& run_;
  std::vector<Piece>& pieces_;
  double eps_;
  const RecognitionOptions& options_;
};

// The sagitta that a chord would have on a curve that turns as the path does at its ends; a hard end says
// nothing.
double implied_sagitta(const Path& path, const Run& run, std::size_t chord) {
  const bool first = run.ends_hard && chord == run.begin, last = run.ends_hard && chord + 1 == run.end;
  const double before = first ? 0 : path.turn[chord], after = last ? 0 : path.turn[chord + 1];
  return path.length[chord] * (before + after) / 16;
}

}  // namespace

void judge_pieces(const Path& path, const Run& run, std::vector<Piece>& pieces, double eps,
                  const RecognitionOptions& options) {
  Judge(path, run, pieces, eps, options).judge();
}

std::optional<Piece> two_chord_arc(const Path& path, const Run& run, std::size_t begin, double eps,
                                   const RecognitionOptions& options) {
  const double shorter = std::min(path.length[begin], path.length[begin + 1]);
  const double slack = 8 * eps / shorter;
  if (slack > 0.05 || unevenness(path, begin, begin + 2) > 1e-3 + slack) return std::nullopt;
  const std::optional<ArcFit> fit = fit_arc(path.run(begin, begin + 2), eps);
  if (!fit) return std::nullopt;
  const Piece piece{begin, begin + 2, fit->arc, fit->residual, true};
  const double sagitta = fit->arc.radius * (1 - std::cos(fit->arc.angle / 2));
  const double radius_slack = 10 * eps * fit->arc.radius / sagitta;
  if (options.evidence) {
    CircularArc placed = fit->arc;
    placed.center += path.origin;
    if (options.evidence->shells[options.shell].circles.has_coaxial(placed, radius_slack)) return piece;
  }
  for (const bool at_end : {false, true}) {
    const std::size_t joint = at_end ? begin + 2 : begin;
    if (run.ends_hard && joint == (at_end ? run.end : run.begin)) return std::nullopt;
    const Point* next = path.beyond(joint, at_end ? 1 : -1);
    if (!next) return std::nullopt;
    const Vector chord = at_end ? Vector(*next - path.points[joint]) : Vector(path.points[joint] - *next);
    if (chord.norm() < shorter) return std::nullopt;  // no straight edge, but a chord like the two
    if (angle_between(chord, tangent_of(piece, at_end)) > kTangent + 4 * slack) return std::nullopt;
  }
  return piece;
}

bool is_coarse_corner(const Path& path, std::size_t vertex, const RecognitionOptions& options) {
  const double shorter = std::min(path.length[vertex - 1], path.length[vertex]);
  const double sagitta = shorter * path.turn[vertex] / 8;
  if (sagitta > 2 * options.coarsest) return true;
  if (!options.evidence || !options.evidence->known()) return false;
  return path.turn[vertex] > 1.5 * options.evidence->angle && sagitta > 5 * options.evidence->sagitta;
}

bool is_long_chord(const Path& path, const Run& run, std::size_t chord, const RecognitionOptions& options) {
  const double own = implied_sagitta(path, run, chord);
  if (options.evidence && options.evidence->known() && own > 5 * options.evidence->sagitta) return true;
  if (own > 2 * options.coarsest) return true;
  double longest = 0, deepest = 0;
  for (std::size_t reach = 1; reach <= 2; ++reach) {
    if (chord >= run.begin + reach) {
      deepest = std::max(deepest, implied_sagitta(path, run, chord - reach));
      if (reach == 1) longest = std::max(longest, path.length[chord - 1]);
    }
    if (chord + reach < run.end) {
      deepest = std::max(deepest, implied_sagitta(path, run, chord + reach));
      if (reach == 1) longest = std::max(longest, path.length[chord + 1]);
    }
  }
  return longest > 0 && path.length[chord] >= 3 * longest && own > 4 * deepest;
}

}  // namespace meshcontour::detail

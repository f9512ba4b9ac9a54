#include "fit/end_tangents.hpp"

#include <cmath>
#include <numbers>
#include <optional>

#include "fit/spline_run.hpp"
#include "meshcontour/parallel.hpp"

namespace meshcontour::detail {

namespace {

constexpr double kNearly = 4 * std::numbers::pi / 180;
constexpr std::size_t kChainsPerTask = 16;

// What a chain's end meets in some loop: the tangent of the neighbour, in the direction of the chain.
struct ChainEnds {
  std::vector<Vector> start, end;
};

// Direction of a curve in the chain's own direction at one of its ends.
std::optional<Vector> exact_tangent(const Recognition& fit, bool at_end) {
  if (fit.pieces.empty()) return std::nullopt;
  const Piece& piece = at_end ? fit.pieces.back() : fit.pieces.front();
  if (!piece.recognized || piece.is_spline()) return std::nullopt;
  return tangent_of(piece, at_end);
}

std::vector<ChainEnds> collect_ends(const ShellRecognition& recognition) {
  std::vector<ChainEnds> ends(recognition.fits.size());
  for (const auto& loops : recognition.chains.uses) {
    for (const std::vector<ChainUse>& uses : loops) {
      for (std::size_t k = 0; k < uses.size() && uses.size() > 1; ++k) {
        const ChainUse &use = uses[k], &next = uses[(k + 1) % uses.size()];
        if (const auto t = exact_tangent(recognition.fits[next.chain], next.reversed)) {
          const Vector along = next.reversed ? Vector(-*t) : *t;
          if (use.reversed)
            ends[use.chain].start.push_back(-along);
          else
            ends[use.chain].end.push_back(along);
        }
        if (const auto t = exact_tangent(recognition.fits[use.chain], !use.reversed)) {
          const Vector along = use.reversed ? Vector(-*t) : *t;
          if (next.reversed)
            ends[next.chain].end.push_back(-along);
          else
            ends[next.chain].start.push_back(along);
        }
      }
    }
  }
  return ends;
}

// The first of the tangents that the curve nearly has by itself.
std::optional<Vector> agreeing(const std::vector<Vector>& tangents, const Vector& own) {
  for (const Vector& t : tangents) {
    if (std::atan2(t.cross(own).norm(), t.dot(own)) < kNearly) return t;
  }
  return std::nullopt;
}

void refit(Recognition& fit, const ChainEnds& ends, double tolerance) {
  for (std::size_t k = 0; k < fit.pieces.size(); ++k) {
    Piece& piece = fit.pieces[k];
    const auto* curve = std::get_if<BSplineCurve>(&piece.curve);
    if (!curve || curve->periodic) continue;
    std::vector<Vector> before = ends.start, after = ends.end;
    if (k > 0) before = {tangent_of(fit.pieces[k - 1], true)};
    if (k + 1 < fit.pieces.size()) after = {tangent_of(fit.pieces[k + 1], false)};
    SplineRunOptions options;
    options.tolerance = tolerance;
    options.start_tangent = agreeing(before, tangent_of(piece, false));
    options.end_tangent = agreeing(after, tangent_of(piece, true));
    if (!options.start_tangent && !options.end_tangent) continue;
    const SplineRun run = fit_spline_run(fit.path.run(piece.begin, piece.end), options);
    if (!run.accepted) continue;
    piece.curve = run.curve;
    piece.residual = run.vertex_error;
    piece.deviation = run.deviation;
  }
}

}  // namespace

void make_splines_tangent(const std::vector<RecognitionOptions>& settings, ShellRecognition& recognition,
                          unsigned threads) {
  const std::vector<ChainEnds> ends = collect_ends(recognition);
  parallel_for(ends.size(), kChainsPerTask, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) refit(recognition.fits[c], ends[c], settings[c].tolerance);
  });
}

}  // namespace meshcontour::detail

#include "fit/gather_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/small_arcs.hpp"

namespace meshcontour::detail {

namespace {

constexpr std::size_t kSampledPoints = 4096;
constexpr int kMostDecimals = 9;    // numbers with more are as good as exact
constexpr int kFewestSamples = 24;  // of a decade, to tell its last digit
constexpr int kSmallestDecade = -8, kLargestDecade = 8;
constexpr double kCoarsestQuantum = 2e-5;  // of the largest coordinate

// Decimals of a number as it was written, kMostDecimals + 1 if there are more.
int decimals_of(double x) {
  double scale = 1;
  for (int d = 0; d <= kMostDecimals; ++d, scale *= 10) {
    const double scaled = x * scale;
    if (std::abs(scaled - std::nearbyint(scaled)) <= 4e-16 * std::abs(scaled)) return d;
  }
  return kMostDecimals + 1;
}

void add_arc(const Recognition& fit, const Piece& piece, ModelEvidence& evidence,
             std::vector<CircularArc>& arcs) {
  CircularArc arc = std::get<CircularArc>(piece.curve);
  if (piece.chords() >= 4) {
    for (std::size_t i = piece.begin; i < piece.end; ++i) {
      const double half = std::asin(std::min(1.0, fit.path.length[i] / (2 * arc.radius)));
      evidence.angle = std::max(evidence.angle, 2 * half);
      evidence.sagitta = std::max(evidence.sagitta, arc.radius * (1 - std::cos(half)));
    }
  }
  arc.center += fit.path.origin;
  arcs.push_back(arc);
}

}  // namespace

ModelEvidence gather_evidence(std::span<const ShellRecognition> shells) {
  ModelEvidence evidence;
  for (const ShellRecognition& shell : shells) {
    std::vector<CircularArc> arcs;
    for (const Recognition& fit : shell.fits) {
      for (const Piece& piece : fit.pieces) {
        if (piece.is_arc() && piece.recognized && piece.chords() >= 3) add_arc(fit, piece, evidence, arcs);
      }
    }
    SmallArcs small = find_small_arcs(shell);
    arcs.insert(arcs.end(), small.pairs.begin(), small.pairs.end());
    evidence.shells.push_back({CircleIndex(std::move(arcs)), std::move(small.chords)});
  }
  return evidence;
}

double coordinate_quantum(const Shell& shell) {
  constexpr std::size_t decades = kLargestDecade - kSmallestDecade + 1;
  std::array<int, decades> samples{}, decimals{};
  double largest = 0;
  bool single = true;
  const std::size_t step = std::max<std::size_t>(1, shell.points.size() / kSampledPoints);
  for (std::size_t i = 0; i < shell.points.size(); i += step) {
    for (const double x : shell.points[i]) {
      largest = std::max(largest, std::abs(x));
      single = single && static_cast<double>(static_cast<float>(x)) == x;
      if (x == 0) continue;
      const int decade = static_cast<int>(std::floor(std::log10(std::abs(x)))) - kSmallestDecade;
      if (decade < 0 || decade >= static_cast<int>(decades)) continue;
      ++samples[static_cast<std::size_t>(decade)];
      int& most = decimals[static_cast<std::size_t>(decade)];
      most = std::max(most, decimals_of(x));
    }
  }
  if (single) return std::ldexp(largest, -24);
  double quantum = 0;
  for (std::size_t d = 0; d < decades; ++d) {
    if (samples[d] < kFewestSamples || decimals[d] > kMostDecimals) continue;
    quantum = std::max(quantum, std::pow(10.0, -decimals[d]));
  }
  return quantum <= kCoarsestQuantum * largest ? quantum : 0;
}

}  // namespace meshcontour::detail

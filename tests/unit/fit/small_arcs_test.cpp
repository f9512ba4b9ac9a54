#include "fit/small_arcs.hpp"

#include <cmath>

#include "support/catch.hpp"

using namespace meshcontour;
using namespace meshcontour::detail;

namespace {

Point on_circle(double angle, double height) {
  return {std::cos(angle), std::sin(angle), height};
}

// A chain whose chords are loose lines.
Recognition loose_chords(const std::vector<Point>& points) {
  Recognition fit;
  fit.path = make_path(points, false);
  for (std::size_t i = 0; i < fit.path.chords(); ++i) fit.pieces.push_back(line_piece(fit.path, i, i + 1));
  return fit;
}

}  // namespace

TEST_CASE("find_small_arcs: single chords count where an axis has pairs, on a bounded number of circles",
          "[fit]") {
  const int heights = GENERATE(2, 1000);
  ShellRecognition shell;
  for (int k = 0; k < 3; ++k) {
    shell.fits.push_back(loose_chords({on_circle(k, 0), on_circle(k + 0.2, 0), on_circle(k + 0.4, 0)}));
    for (int h = 1; h <= heights; ++h) {
      shell.fits.push_back(loose_chords({on_circle(k, 0.01 * h), on_circle(k + 0.2, 0.01 * h)}));
    }
  }
  const SmallArcs found = find_small_arcs(shell);
  CHECK(found.pairs.size() == 1);
  CHECK(found.chords.size() >= 2);
  CHECK(found.chords.size() <= 512);
  for (const CircularArc& circle : found.chords) CHECK(circle.radius == Approx(1));
}

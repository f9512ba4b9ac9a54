#include <algorithm>

#include "meshcontour/fit.hpp"

namespace meshcontour {

std::vector<std::vector<bool>> repeated_segments(std::span<const Contour> contours) {
  std::size_t shells = 0;
  for (const Contour& contour : contours) shells = std::max(shells, contour.shell + 1);
  std::vector<std::vector<bool>> written(shells);
  std::vector<std::vector<bool>> repeated;
  repeated.reserve(contours.size());
  for (const Contour& contour : contours) {
    std::vector<bool>& done = written[contour.shell];
    std::vector<bool>& flags = repeated.emplace_back(contour.segments.size(), false);
    for (std::size_t i = 0; i < flags.size(); ++i) {
      const Segment& segment = contour.segments[i];
      const std::size_t first = segment.edge, last = first + segment.edge_count;
      if (done.size() < last) done.resize(last, false);
      bool known = segment.edge_count > 0;
      for (std::size_t edge = first; edge < last; ++edge) known = known && done[edge];
      for (std::size_t edge = first; edge < last; ++edge) done[edge] = true;
      flags[i] = known;
    }
  }
  return repeated;
}

}  // namespace meshcontour

#include "multires/curve_split.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace meshcontour::detail {
namespace {

struct Part {
  std::size_t first = 0, last = 0;  // of the places
  std::size_t begin = 0, end = 0;   // of the chain's vertices
};

// The vertex in a part that is nearest to its middle; with room on both sides for all other ones if there is.
std::size_t middle_vertex(const Part& part, const std::vector<double>& sums) {
  const std::size_t room = (part.last - part.first) / 2;
  std::size_t low = part.begin + 1, high = part.end - 1;
  if (part.end - part.begin <= 2 * room) {
    low = std::max(low, part.end - std::min(part.end, room));
    high = std::min(high, part.begin + room);
  }
  const double middle = (sums[part.begin] + sums[part.end]) / 2;
  std::size_t best = low;
  for (std::size_t v = low; v <= high; ++v) {
    if (std::abs(sums[v] - middle) < std::abs(sums[best] - middle)) best = v;
  }
  return best;
}

}  // namespace

CurveSplit split_curve(std::span<const double> lengths, unsigned levels) {
  std::vector<double> sums(lengths.size() + 1, 0);
  for (std::size_t i = 0; i < lengths.size(); ++i) sums[i + 1] = sums[i] + lengths[i];
  const std::size_t count = std::size_t{1} << levels;
  CurveSplit split{std::vector<double>(count + 1, 0), std::vector<double>(count + 1, 0)};
  std::vector<Part> parts = {{0, count, 0, lengths.size()}};
  split.places[count] = static_cast<double>(lengths.size());
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    if (part.last - part.first < 2) continue;
    if (part.end - part.begin == 1) {
      const auto steps = static_cast<double>(part.last - part.first);
      for (std::size_t i = part.first + 1; i < part.last; ++i)
        split.places[i] = static_cast<double>(part.begin) + static_cast<double>(i - part.first) / steps;
      continue;
    }
    const std::size_t middle = (part.first + part.last) / 2, vertex = middle_vertex(part, sums);
    split.places[middle] = static_cast<double>(vertex);
    parts.push_back({part.first, middle, part.begin, vertex});
    parts.push_back({middle, part.last, vertex, part.end});
  }
  const double whole = sums.back();
  for (std::size_t i = 1; i <= count; ++i) {
    const auto edge = std::min(static_cast<std::size_t>(split.places[i]), lengths.size() - 1);
    const double share = split.places[i] - static_cast<double>(edge);
    split.shares[i] = whole > 0 ? (sums[edge] + share * lengths[edge]) / whole
                                : static_cast<double>(i) / static_cast<double>(count);
  }
  return split;
}

}  // namespace meshcontour::detail

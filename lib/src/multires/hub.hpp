#pragma once

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "multires/stencil.hpp"

namespace meshcontour::detail {

/// What the ring around a hub gives to the middle of each of its edges by butterfly_weights(), in linear
/// time: the weights are two harmonics and a constant, so that five sums over the ring tell all.
///
/// @param ring  one a neighbour, in cyclic order.
template <class Value>
std::vector<Value> ring_shares(std::span<const Value> ring) {
  const auto count = static_cast<double>(ring.size());
  const auto angle = [&](std::size_t i) { return 2 * std::numbers::pi * static_cast<double>(i) / count; };
  const Value zero = 0.0 * ring[0];
  Value all = zero, cosine = zero, sine = zero, double_cosine = zero, double_sine = zero;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    all += ring[i];
    cosine += std::cos(angle(i)) * ring[i];
    sine += std::sin(angle(i)) * ring[i];
    double_cosine += std::cos(2 * angle(i)) * ring[i];
    double_sine += std::sin(2 * angle(i)) * ring[i];
  }
  std::vector<Value> shares(ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Value first = std::cos(angle(i)) * cosine + std::sin(angle(i)) * sine;
    const Value second = std::cos(2 * angle(i)) * double_cosine + std::sin(2 * angle(i)) * double_sine;
    shares[i] = (0.25 * all + first + 0.5 * second) / count;
  }
  return shares;
}

/// Adds `sign` times what hubs give to the odd values, which stand behind the even ones. Linear.
template <class Value>
void add_hub_predictions(const Stencils& stencils, double sign, std::span<Value> values) {
  std::vector<Value> ring;
  for (const Index hub : stencils.hubs()) {
    const std::vector<Stencils::Spoke> spokes = stencils.spokes(hub);
    ring.clear();
    for (const Stencils::Spoke& spoke : spokes) ring.push_back(values[spoke.end]);
    const std::vector<Value> shares = ring_shares(std::span<const Value>(ring));
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      values[spokes[i].odd] += sign * spokes[i].scale * (Stencils::kCentre * values[hub] + shares[i]);
    }
  }
}

/// The transpose: adds to even values what hubs would give of them to the odd ones.
inline void add_hub_transposed(const Stencils& stencils, std::span<const double> odd_and_even,
                               std::span<double> even) {
  std::vector<double> ring;
  for (const Index hub : stencils.hubs()) {
    const std::vector<Stencils::Spoke> spokes = stencils.spokes(hub);
    ring.clear();
    for (const Stencils::Spoke& spoke : spokes) ring.push_back(spoke.scale * odd_and_even[spoke.odd]);
    const std::vector<double> shares = ring_shares(std::span<const double>(ring));
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      even[spokes[i].end] += shares[i];
      even[hub] += Stencils::kCentre * ring[i];
    }
  }
}

}  // namespace meshcontour::detail

#pragma once

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "multires/stencil.hpp"
#include "multires/trigonometric_rule.hpp"

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

/// Adds `sign` times what fans give to the odd values.
template <class Value>
void add_fan_predictions(const Stencils& stencils, double sign, std::span<Value> values) {
  for (const Index first : stencils.fans()) {
    const Stencils::Fan fan = stencils.fan(first);
    const std::size_t count = fan.spokes.size() + 1;
    const TrigonometricRule rule(count);
    const Value across = values[fan.first] - values[fan.last];
    Value sines = 0.0 * across, double_sines = sines;
    for (std::size_t j = 1; j < count; ++j) {
      const Value& value = values[fan.spokes[j - 1].end];
      sines += rule.sine(j) * value;
      double_sines += rule.double_sine(j) * value;
    }
    for (std::size_t i = 1; i < count; ++i) {
      const Stencils::Spoke& spoke = fan.spokes[i - 1];
      values[spoke.odd] +=
          sign * spoke.scale *
          (rule.centre(i) * values[fan.centre] + rule.end(i) * across + rule.inner(i, sines, double_sines));
    }
  }
}

/// Adds `sign` times what hubs and fans give to the odd values, which stand behind the even ones. Linear.
template <class Value>
void add_hub_predictions(const Stencils& stencils, double sign, std::span<Value> values) {
  add_fan_predictions(stencils, sign, values);
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

/// The transpose of add_fan_predictions().
inline void add_fan_transposed(const Stencils& stencils, std::span<const double> odd_and_even,
                               std::span<double> even) {
  for (const Index first : stencils.fans()) {
    const Stencils::Fan fan = stencils.fan(first);
    const std::size_t count = fan.spokes.size() + 1;
    const TrigonometricRule rule(count);
    double sines = 0, double_sines = 0;
    for (std::size_t i = 1; i < count; ++i) {
      const double odd = fan.spokes[i - 1].scale * odd_and_even[fan.spokes[i - 1].odd];
      sines += rule.sine(i) * odd;
      double_sines += rule.double_sine(i) * odd;
      even[fan.centre] += rule.centre(i) * odd;
      even[fan.first] += rule.end(i) * odd;
      even[fan.last] -= rule.end(i) * odd;
    }
    for (std::size_t j = 1; j < count; ++j) even[fan.spokes[j - 1].end] += rule.inner(j, sines, double_sines);
  }
}

/// The transpose: adds to even values what hubs and fans would give of them to the odd ones.
inline void add_hub_transposed(const Stencils& stencils, std::span<const double> odd_and_even,
                               std::span<double> even) {
  add_fan_transposed(stencils, odd_and_even, even);
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

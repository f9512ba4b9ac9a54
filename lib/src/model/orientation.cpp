#include "model/orientation.hpp"

#include <algorithm>
#include <utility>

namespace meshcontour::detail {
namespace {

enum State : std::uint8_t { kUnseen, kKept, kTurned };

// One component, walked from its first triangle.
struct Component {
  std::vector<Index> triangles;
  std::size_t turned = 0;  // against the first triangle
  bool orientable = true;
  bool closed = true;
};

bool runs_same_way(const Shell& shell, Index side, Index other) {
  return side_start(shell.triangles, side) == side_start(shell.triangles, other);
}

bool is_consistent(const Shell& shell, const Adjacency& adjacency) {
  for (Index side = 0; side < adjacency.opposite.size(); ++side) {
    const Index other = adjacency.opposite[side];
    if (is_paired(other) && other > side && runs_same_way(shell, side, other)) return false;
  }
  return true;
}

Component walk(const Shell& shell, const Adjacency& adjacency, Index first, std::vector<State>& states) {
  Component component;
  component.triangles.push_back(first);
  states[first] = kKept;
  for (std::size_t next = 0; next < component.triangles.size(); ++next) {
    const Index triangle = component.triangles[next];
    for (Index side = 3 * triangle; side < 3 * triangle + 3; ++side) {
      const Index other = adjacency.opposite[side];
      if (!is_paired(other)) {
        component.closed = false;
        continue;
      }
      const bool turned = (states[triangle] == kTurned) != runs_same_way(shell, side, other);
      const State wanted = turned ? kTurned : kKept;
      State& state = states[triangle_of(other)];
      if (state == kUnseen) {
        state = wanted;
        component.turned += turned ? 1 : 0;
        component.triangles.push_back(triangle_of(other));
      } else if (state != wanted) {
        component.orientable = false;
      }
    }
  }
  return component;
}

// Six times the signed volume, seen from one of its points, once the turned triangles are turned.
double signed_volume(const Shell& shell, const Component& component, const std::vector<State>& states) {
  const Point origin = shell.points[shell.triangles[component.triangles[0]][0]];
  double volume = 0;
  for (const Index t : component.triangles) {
    const Triangle& corners = shell.triangles[t];
    const Vector a = shell.points[corners[0]] - origin;
    const Vector b = shell.points[corners[1]] - origin, c = shell.points[corners[2]] - origin;
    volume += (states[t] == kTurned ? -1 : 1) * a.dot(b.cross(c));
  }
  return volume;
}

bool should_invert(const Shell& shell, const Component& component, const std::vector<State>& states) {
  if (component.closed) {
    const double volume = signed_volume(shell, component, states);
    if (volume != 0) return volume < 0;
  }
  return component.turned > component.triangles.size() - component.turned;
}

// Sides 0 and 2 of a turned triangle change places.
Index after_turning(Index side, const std::vector<State>& states) {
  if (!is_paired(side) || states[triangle_of(side)] != kTurned) return side;
  return 3 * triangle_of(side) + 2 - side % 3;
}

void turn(Shell& shell, Adjacency& adjacency, const std::vector<State>& states) {
  for (Index& side : adjacency.opposite) side = after_turning(side, states);
  for (std::size_t t = 0; t < shell.triangles.size(); ++t) {
    if (states[t] != kTurned) continue;
    std::swap(shell.triangles[t][1], shell.triangles[t][2]);
    std::swap(adjacency.opposite[3 * t], adjacency.opposite[3 * t + 2]);
    if (!shell.corner_normals.empty())
      std::swap(shell.corner_normals[3 * t + 1], shell.corner_normals[3 * t + 2]);
  }
}

}  // namespace

OrientationCounts orient_components(Shell& shell, Adjacency& adjacency, Unorientable unorientable) {
  OrientationCounts counts;
  if (is_consistent(shell, adjacency)) return counts;
  std::vector<State> states(shell.triangles.size(), kUnseen);
  for (Index first = 0; first < states.size(); ++first) {
    if (states[first] != kUnseen) continue;
    const Component component = walk(shell, adjacency, first, states);
    if (!component.orientable) ++counts.unorientable;
    if (!component.orientable && unorientable == Unorientable::Keep) {
      for (const Index t : component.triangles) states[t] = kKept;
    } else if (component.turned > 0 && should_invert(shell, component, states)) {
      for (const Index t : component.triangles) states[t] = states[t] == kTurned ? kKept : kTurned;
    }
  }
  turn(shell, adjacency, states);
  counts.turned = static_cast<std::size_t>(std::ranges::count(states, kTurned));
  return counts;
}

}  // namespace meshcontour::detail

#pragma once

// Meshes with every fault that files bring, and brute-force answers about them.

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "meshcontour/model.hpp"

namespace dirty {

using namespace meshcontour;

inline Shell make_shell(std::vector<Point> points, std::vector<Triangle> triangles) {
  Shell shell;
  shell.id = "dirty";
  shell.patches = {{"", {}, 0, triangles.size()}};
  shell.points = std::move(points);
  shell.triangles = std::move(triangles);
  return shell;
}

inline std::vector<Triangle> split_quads(const std::vector<std::array<Index, 4>>& quads) {
  std::vector<Triangle> triangles;
  for (const auto& q : quads) {
    triangles.push_back({q[0], q[1], q[2]});
    triangles.push_back({q[0], q[2], q[3]});
  }
  return triangles;
}

// A cube of 12 triangles from the origin to (1, 1, 1), outward.
inline Shell cube() {
  std::vector<Point> points;
  for (int i = 0; i < 8; ++i) points.push_back(Point(i & 1, i >> 1 & 1, i >> 2 & 1));
  return make_shell(
      points,
      split_quads({{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}));
}

// A band of n quads that closes after `half_turns` half turns: 0 an open cylinder, 1 a Moebius strip.
inline Shell band(Index n, int half_turns) {
  std::vector<Point> points;
  std::vector<std::array<Index, 4>> quads;
  for (Index i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * i / n, twist = half_turns * t / 2;
    for (const double w : {-0.3, 0.3}) {
      const double r = 1 + w * std::cos(twist);
      points.push_back({r * std::cos(t), r * std::sin(t), w * std::sin(twist)});
    }
    Index a = 2 * i + 2, b = 2 * i + 3;
    if (i + 1 == n) a = half_turns % 2 == 0 ? 0 : 1, b = 1 - a;
    quads.push_back({2 * i, a, b, 2 * i + 1});
  }
  return make_shell(points, split_quads(quads));
}

inline Shell moebius_strip(Index n = 12) {
  return band(n, 1);
}

// A grid of n x m quads closed in both directions; `reversed`: the second closes with a reflection.
inline Shell closed_grid(Index n, Index m, bool reversed) {
  std::vector<Point> points;
  std::vector<std::array<Index, 4>> quads;
  for (Index i = 0; i < n; ++i) {
    for (Index k = 0; k < m; ++k) {
      const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * k / m;
      const double r =
          3 + (reversed ? std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v) : std::cos(v));
      const double z =
          reversed ? std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v) : std::sin(v);
      points.push_back({r * std::cos(u), r * std::sin(u), z});
      const auto at = [&](Index row, Index column) {
        column %= m;
        return row < n ? row * m + column : (reversed ? (m - column) % m : column);
      };
      quads.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return make_shell(points, split_quads(quads));
}

inline Shell klein_bottle(Index n = 16, Index m = 10) {
  return closed_grid(n, m, true);
}

inline Shell torus(Index n = 16, Index m = 10) {
  return closed_grid(n, m, false);
}

// Two triangles that share a point and nothing else.
inline Shell bow_tie() {
  return make_shell({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
}

// Three triangles on the edge 0-1.
inline Shell fin() {
  return make_shell({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0.5, 0, 1}},
                    {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
}

inline Shell two_cubes_touching_in_a_vertex() {
  Shell shell = cube();
  const std::size_t triangles = shell.triangles.size();
  const auto moved = [](Index v) {
    return v == 0 ? Index{7} : v + 7;
  };  // its point 0 is the first cube's point 7
  for (Index v = 1; v < 8; ++v) shell.points.push_back(Point(shell.points[v] + Vector(1, 1, 1)));
  for (std::size_t t = 0; t < triangles; ++t) {
    const Triangle& c = shell.triangles[t];
    shell.triangles.push_back({moved(c[0]), moved(c[1]), moved(c[2])});
  }
  shell.patches[0].triangle_count = shell.triangles.size();
  return shell;
}

// Turns the triangles whose numbers are given.
inline Shell with_turned(Shell shell, const std::vector<std::size_t>& triangles) {
  for (const std::size_t t : triangles) std::swap(shell.triangles[t][1], shell.triangles[t][2]);
  return shell;
}

inline Shell with_triangles(Shell shell, const std::vector<Triangle>& more) {
  shell.triangles.insert(shell.triangles.end(), more.begin(), more.end());
  shell.patches[0].triangle_count = shell.triangles.size();
  return shell;
}

inline Shell with_isolated_points(Shell shell, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) shell.points.push_back(Point(double(i), 5, 5));
  return shell;
}

// Random triangles over few points: every fault at once.
inline Shell soup(std::mt19937& random, Index points, std::size_t triangles) {
  Shell shell;
  for (Index v = 0; v < points; ++v) {
    shell.points.push_back({double(random() % 1000), double(random() % 1000), double(random() % 1000)});
  }
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto corner = [&] { return static_cast<Index>(random() % points); };
    const Index a = corner(), b = corner(), c = corner();
    shell.triangles.push_back({a, b, c});
  }
  shell.patches = {{"", {}, 0, triangles}};
  return shell;
}

using EdgeTriangles = std::map<std::pair<Index, Index>, std::vector<std::size_t>>;

inline EdgeTriangles triangles_by_edge(const Shell& shell) {
  EdgeTriangles edges;
  for (std::size_t t = 0; t < shell.triangles.size(); ++t) {
    const Triangle& c = shell.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      edges[std::minmax(c[k], c[(k + 1) % 3])].push_back(t);
    }
  }
  return edges;
}

inline bool runs(const Triangle& t, Index from, Index to) {
  return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) || (t[2] == from && t[0] == to);
}

// The pieces that remain when items 0..count are joined by the links, as the smallest member of each item's
// piece.
inline std::vector<std::size_t> pieces(std::size_t count,
                                       const std::vector<std::pair<std::size_t, std::size_t>>& links) {
  std::vector<std::size_t> piece(count);
  for (std::size_t i = 0; i < count; ++i) piece[i] = i;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b] : links) {
      const std::size_t least = std::min(piece[a], piece[b]);
      changed = changed || piece[a] != least || piece[b] != least;
      piece[a] = piece[b] = least;
    }
  }
  return piece;
}

// Fans of a point: its triangles, joined where `joined(edge's triangles)` holds for an edge at the point.
template <typename Joined>
std::size_t fan_count(const Shell& shell, const EdgeTriangles& edges, Index point, Joined&& joined) {
  std::vector<std::pair<std::size_t, std::size_t>> links;
  std::set<std::size_t> at_point;
  for (std::size_t t = 0; t < shell.triangles.size(); ++t) {
    if (std::ranges::count(shell.triangles[t], point) > 0) at_point.insert(t);
  }
  for (const auto& [edge, triangles] : edges) {
    if (edge.first != point && edge.second != point) continue;
    if (triangles.size() == 2 && joined(edge, triangles)) links.push_back({triangles[0], triangles[1]});
  }
  const auto piece = pieces(shell.triangles.size(), links);
  std::set<std::size_t> fans;
  for (const std::size_t t : at_point) fans.insert(piece[t]);
  return fans.size();
}

}  // namespace dirty

#pragma once

// Small models made by hand for the pictures.

#include <array>
#include <cmath>
#include <numbers>

#include "meshcontour/boundary.hpp"
#include "meshcontour/render.hpp"

namespace solids {

using namespace meshcontour;

/// A cylinder about the z axis with `chords` around, in three patches: side, bottom, top.
inline Shell cylinder(Index chords, double radius, double height) {
  Shell shell;
  shell.id = "cylinder";
  for (const double z : {0.0, height}) {
    for (Index i = 0; i < chords; ++i) {
      const double angle = 2 * std::numbers::pi * i / chords;
      shell.points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }
  shell.points.push_back({0, 0, 0});
  shell.points.push_back({0, 0, height});
  const auto next = [&](Index i) { return (i + 1) % chords; };
  for (Index i = 0; i < chords; ++i) {
    shell.triangles.push_back({i, next(i), chords + next(i)});
    shell.triangles.push_back({i, chords + next(i), chords + i});
  }
  for (Index i = 0; i < chords; ++i) shell.triangles.push_back({2 * chords, next(i), i});
  for (Index i = 0; i < chords; ++i)
    shell.triangles.push_back({2 * chords + 1, chords + i, chords + next(i)});
  shell.patches = {{"side", {200, 60, 60, 255}, 0, 2 * chords},
                   {"bottom", {60, 160, 60, 255}, 2 * chords, chords},
                   {"top", {60, 60, 200, 255}, 3 * chords, chords}};
  return shell;
}

/// A rectangle in a plane z = const, one patch, facing up.
inline Shell rectangle(const Point& low, const Point& high, const Rgba& color) {
  Shell shell;
  shell.id = "rectangle";
  shell.points = {low, {high.x(), low.y(), low.z()}, high, {low.x(), high.y(), low.z()}};
  shell.triangles = {{0, 1, 2}, {0, 2, 3}};
  shell.patches = {{"", color, 0, 2}};
  return shell;
}

/// A box of one colour, a patch a side, seen from outside.
inline Shell box(const Point& low, const Point& high, const Rgba& color) {
  Shell shell;
  shell.id = "box";
  for (int corner = 0; corner < 8; ++corner) {
    shell.points.push_back(
        {corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(), corner & 4 ? high.z() : low.z()});
  }
  constexpr std::array<std::array<Index, 4>, 6> sides = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& side : sides) {
    shell.patches.push_back({"", color, shell.triangles.size(), 2});
    shell.triangles.push_back({side[0], side[1], side[2]});
    shell.triangles.push_back({side[0], side[2], side[3]});
  }
  return shell;
}

inline Model placed(std::vector<Shell> shells) {
  Model model;
  model.shells = std::move(shells);
  for (std::size_t s = 0; s < model.shells.size(); ++s) {
    Instance instance;
    instance.shell = s;
    model.instances.push_back(instance);
  }
  return model;
}

inline Image picture(const Model& model, const RenderOptions& options,
                     std::span<const Contour> contours = {}) {
  std::vector<Diagnostic> diagnostics;
  const auto boundaries = extract_boundaries(model, {}, diagnostics);
  return render(model, boundaries, contours, options);
}

inline Rgba pixel(const Image& image, int x, int y) {
  const auto* p = &image.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                   static_cast<std::size_t>(x))];
  return {p[0], p[1], p[2], p[3]};
}

/// The middle of the pixels that a test holds of, y up; the origin if there are none.
template <class Test>
Eigen::Vector2d middle(const Image& image, const Test& test) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!test(pixel(image, x, y))) continue;
      sum += Eigen::Vector2d(x, image.height - y);
      ++count;
    }
  }
  return count > 0 ? Eigen::Vector2d(sum / count) : Eigen::Vector2d::Zero();
}

}  // namespace solids

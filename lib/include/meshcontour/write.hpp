#pragma once

#include <span>
#include <string>
#include <string_view>

#include "meshcontour/boundary.hpp"
#include "meshcontour/curve.hpp"
#include "meshcontour/render.hpp"

namespace meshcontour {

/// What a run has produced, as the writers see it.
struct Result {
  const Model& model;
  std::span<const ShellBoundary> boundaries;
  std::span<const Contour> contours;
  std::string_view extractor = "sorted";
};

}  // namespace meshcontour

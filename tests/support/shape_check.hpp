#pragma once

// Fits a disturbed tessellation of a known shape and compares the contour to the truth.

#include <string>
#include <vector>

#include "meshcontour/fit.hpp"
#include "support/shapes.hpp"

namespace shapes {

/// What is done to the vertices of a loop before it is fitted.
struct Disturbance {
  std::string name;
  bool rotate = false;   ///< a random rotation
  bool shift = false;    ///< another first vertex
  bool reverse = false;  ///< the other direction
  double scale = 1;
  double offset = 0;    ///< added to every coordinate
  bool single = false;  ///< rounded to single precision
  int decimals = -1;    ///< rounded to so many decimals
  double noise = 0;     ///< standard deviation of the coordinates, shares of the shape's size
  unsigned repeats = 1;
};

std::vector<Disturbance> disturbances();

struct Check {
  bool kinds_exact = false;    ///< the true kinds between the true joints, no more and no less
  std::string found;           ///< kinds, in the order of the true edges where they begin at a joint
  int corners = 0;             ///< joints without a common tangent
  double primitive_error = 0;  ///< largest distance of a line, arc, circle or ellipse to its true edge / size
  double deviation = 0;        ///< the contour's certificate / size
};

Check check_shape(const Shape& shape, double tau, Steps steps, const Disturbance& disturbance, unsigned seed);

}  // namespace shapes

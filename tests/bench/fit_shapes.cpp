// How well the contours of known shapes are taken apart: kinds, corners and distance to the true edges, over
// tessellations and disturbances of the vertices.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "support/shape_check.hpp"

using namespace meshcontour;

namespace {

struct Setting {
  std::string name;
  double noise = 0;  // of the shape's size
  int repeats = 1;
};

struct Tally {
  int cases = 0, kinds = 0, corners = 0;
  double worst = 0;
};

void print_failure(const std::string& name, const shapes::Shape& shape, double tau, shapes::Steps steps,
                   const shapes::Check& check) {
  fmt::print("    {} {} tau {:.0e} {}: {} (truth {}), corners {} of {}\n", name, shape.name, tau,
             steps == shapes::Steps::Uniform ? "uniform" : "adaptive", check.found, shape.kinds(),
             check.corners, shape.corners);
}

void add(Tally& tally, const shapes::Check& check, const shapes::Shape& shape) {
  ++tally.cases;
  tally.kinds += check.kinds_exact;
  tally.corners += check.corners == shape.corners;
  tally.worst = std::max(tally.worst, check.primitive_error);
}

}  // namespace

// Arguments: names of disturbances; none: all.
int main(int count, char** arguments) {
  const bool verbose = std::getenv("VERBOSE") != nullptr;
  const std::vector<std::string> chosen(arguments + 1, arguments + count);
  const auto skipped = [&](const std::string& name) {
    return !chosen.empty() && std::find(chosen.begin(), chosen.end(), name) == chosen.end();
  };
  for (const double tau : {1e-4, 1e-5}) {
    for (const shapes::Disturbance& disturbance : shapes::disturbances()) {
      if (skipped(disturbance.name)) continue;
      Tally tally;
      for (const shapes::Shape& shape : shapes::all()) {
        for (const shapes::Steps steps : {shapes::Steps::Adaptive, shapes::Steps::Uniform}) {
          for (unsigned seed = 0; seed < disturbance.repeats; ++seed) {
            const shapes::Check check = shapes::check_shape(shape, tau, steps, disturbance, seed);
            add(tally, check, shape);
            if (verbose && !(check.kinds_exact && check.corners == shape.corners)) {
              print_failure(disturbance.name, shape, tau, steps, check);
            }
          }
        }
      }
      fmt::print("tau {:.0e} {:14} kinds {:4}/{:4} corners {:4}/{:4} primitive error {:.1e}\n", tau,
                 disturbance.name, tally.kinds, tally.cases, tally.corners, tally.cases, tally.worst);
    }
    for (const shapes::Disturbance& disturbance : shapes::disturbances()) {
      if (skipped(disturbance.name)) continue;
      std::mt19937 random(7);
      Tally tally;
      for (unsigned k = 0; k < 60; ++k) {
        const shapes::Shape shape = shapes::rounded_polygon(random);
        const shapes::Check check = shapes::check_shape(shape, tau, shapes::Steps::Adaptive, disturbance, k);
        add(tally, check, shape);
        if (verbose && !check.kinds_exact)
          print_failure(disturbance.name, shape, tau, shapes::Steps::Adaptive, check);
      }
      fmt::print("tau {:.0e} {:14} rounded polygons {:2}/60, primitive error {:.1e}\n", tau, disturbance.name,
                 tally.kinds, tally.worst);
    }
  }
}

#pragma once

// What a mesh is, counted and measured without help from the library.

#include <cstddef>
#include <string>
#include <vector>

#include "meshcontour/model.hpp"
#include "meshcontour/read.hpp"

namespace sweeps {

using namespace meshcontour;

struct Survey {
  std::size_t vertices = 0, edges = 0, faces = 0, components = 0, boundary_loops = 0;
  std::size_t bad_edges = 0;  ///< with three or more triangles, or two in the same direction
  std::size_t unused_vertices = 0;
  std::size_t disagreeing = 0;  ///< corners whose normal is not of length 1 or looks into the triangle
  double area = 0, volume = 0;
  double least_volume = 0;    ///< of the closed components; +infinity if there are none
  double least_distance = 0;  ///< between two vertices of a component, over its diagonal
  double least_face = 0;      ///< area over the square of the diagonal

  long euler() const;
  bool closed() const { return boundary_loops == 0; }
};

Survey survey(const Shell& shell);

/// A file of the tests' own.
std::string data_file(const std::string& name);
std::string data_bytes(const std::string& name);

/// Reads text as a sweep file.
Model read_text(const std::string& text, const SweepOptions& options = {});

/// Area and volume of the polyline (x, y) turned about the y axis in `steps` steps.
double turned_area(const std::vector<Eigen::Vector2d>& polyline, std::size_t steps);
double turned_volume(const std::vector<Eigen::Vector2d>& polyline, std::size_t steps);

}  // namespace sweeps

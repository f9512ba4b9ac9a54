#pragma once

// Closed loops as a designer draws them, known exactly, and how a tessellator sees them.

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "meshcontour/boundary.hpp"
#include "meshcontour/model.hpp"

namespace shapes {

using meshcontour::Point;

/// One true edge. `kind`: L line, A arc, C circle, E ellipse, S anything else.
struct Edge {
  char kind = 'L';
  std::function<Point(double)> at;
  double begin = 0, end = 1;
  double radius = 0;  ///< of arcs and circles
  int chords = 0;     ///< forced number of chords; 0: as the sagitta asks
};

/// A closed loop of true edges.
struct Shape {
  std::string name;
  std::vector<Edge> edges;
  int corners = 0;  ///< joints without a common tangent

  std::string kinds() const;
};

/// The vertices of a loop, and which of them begin a true edge.
struct Loop {
  std::vector<Point> points;
  std::vector<std::size_t> joints;
};

enum class Steps {
  Adaptive,  ///< each chord as long as sagitta and angle allow
  Uniform,   ///< equal steps of the edge's parameter
};

Edge line(const Point& from, const Point& to);
Edge arc(const Point& center, double radius, double begin, double end);  ///< in the xy plane
Shape regular_polygon(int sides, double radius);

/// A convex polygon with rounded corners of different radii, in a random plane: lines and arcs by turns.
Shape rounded_polygon(std::mt19937& random);

/// The loops that the tool must take apart exactly.
std::vector<Shape> all();

/// The same shape after a map that keeps shapes.
Shape moved(const Shape& shape, const Eigen::Affine3d& map);

/// Size of a shape: the diagonal of its box.
double size(const Shape& shape);

/// Vertices on the true edges, chords at most `sagitta` and half a radian off them.
Loop tessellate(const Shape& shape, double sagitta, Steps steps);

/// A model that is one loop: a fan of triangles around a point inside, and its boundary.
meshcontour::Model model_of(const std::vector<Point>& loop);
std::vector<meshcontour::ShellBoundary> boundary_of(const std::vector<Point>& loop);

}  // namespace shapes

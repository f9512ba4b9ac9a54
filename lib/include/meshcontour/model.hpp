#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "meshcontour/curve.hpp"
#include "meshcontour/error.hpp"
#include "meshcontour/types.hpp"

namespace meshcontour {

/// A smooth piece of a shell, for a webxml file one <facets> element: one B-rep face.
/// It is a range of the shell's triangles; patches follow one another without gap or overlap.
struct Patch {
  std::string name;
  Rgba color;
  std::size_t first_triangle = 0;
  std::size_t triangle_count = 0;
};

/// The faces of a file that has polygons, as they stand there; cut into fans from their first corners they
/// give the triangles of the shell, as long as nothing changes these.
struct Polygons {
  std::vector<Index> sizes;    ///< corners of each, 3 or more
  std::vector<Index> corners;  ///< of all, indices into Shell::points
};

/// Triangles that share one list of points, in a frame and unit of their own.
struct Shell {
  std::string id;
  Rgba color;
  std::vector<Point> points;  ///< finite; a point may be used by several patches, or by none
  std::vector<Triangle> triangles;
  std::vector<Patch> patches;
  std::vector<Vector>
      corner_normals;  ///< 3 a triangle, of length 1, or (0,0,0) where unknown; or the whole list empty
  std::vector<double>
      details;  ///< one a point: the length of its wavelet coefficient, for pictures; or empty
  std::vector<std::array<Index, 2>> creases;  ///< sharp edges inside a patch, sorted: drawn, but no boundary
  std::vector<Eigen::Vector4d>
      point_colors;  ///< red, green, blue and alpha from 0 to 1, one a point; or empty
  std::vector<Eigen::Vector2d> texture_coordinates;  ///< one a point; or empty
  Polygons polygons;  ///< of a control mesh that has others than triangles; or empty

  /// The triangles of one patch.
  std::span<const Triangle> patch_triangles(std::size_t patch) const {
    return std::span(triangles).subspan(patches[patch].first_triangle, patches[patch].triangle_count);
  }
};

/// One occurrence of a shell in the model.
struct Instance {
  std::size_t shell = 0;                                    ///< index into Model::shells
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();  ///< shell frame to model frame; may mirror
  std::string path;  ///< product and shape ids from the root, joined by '/'
};

/// A line drawing that comes with the model (PMI, construction geometry), already placed in the model frame.
struct Polyline {
  std::string name;
  std::vector<Point> points;
};

/// A point of a curve with a right-handed frame: (normal, binormal, tangent) are of length 1 and
/// perpendicular.
struct CurveFrame {
  Point position = Point::Zero();
  Vector tangent = Vector::UnitZ(), normal = Vector::UnitX(), binormal = Vector::UnitY();
};

/// A curve that the file itself gives, already placed in the model frame. It is drawn and exported as it is.
struct NamedCurve {
  std::string name;
  Curve curve;
  std::vector<CurveFrame> frames;  ///< at the samples that the file asks for, along the curve; may be empty
};

/// A picture that a control mesh names; it is never opened.
struct Texture {
  std::string use;  ///< BaseTexture, GlossTexture or EnvTexture
  std::string name;
  std::uint32_t width = 0, height = 0;  ///< pixels
};

/// Everything that a file says. Shells are stored once however often they are placed.
struct Model {
  std::string name;
  double metres_per_unit = 0;  ///< 0: unknown
  bool has_patches = true;     ///< false: the file knows none, and one patch holds all triangles of a shell
  std::vector<Shell> shells;
  std::vector<Instance> instances;
  std::vector<Polyline> annotations;
  std::vector<NamedCurve> curves;
  std::vector<Polyline> tree;     ///< spanning trees of the patches, placed; when asked for, see graph.hpp
  std::vector<Polyline> path;     ///< the shortest path between two vertices, placed; likewise
  std::vector<Texture> textures;  ///< one a use at most, in the order above
  std::vector<Diagnostic> diagnostics;
};

/// The box of the points that a triangle uses, in the shell's frame; empty for a shell without triangles.
Box bounding_box(const Shell& shell);

/// The box of all instances, annotations and curves (these by points, sixteen a span), in the model's frame.
Box bounding_box(const Model& model);

/// Checks what every stage relies on: indices in range, points finite, patches a partition of the triangles,
/// corner normals none or three a triangle, colours and texture coordinates none or one a point, instances
/// naming a shell.
///
/// @throws Error   Internal, naming the shell and what is wrong: a reader or a generator broke its promise.
void validate(const Model& model);

}  // namespace meshcontour

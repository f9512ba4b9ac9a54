#pragma once

#include <cstddef>
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

/// Triangles that share one list of points, in a frame and unit of their own.
struct Shell {
  std::string id;
  Rgba color;
  std::vector<Point> points;  ///< finite; a point may be used by several patches, or by none
  std::vector<Triangle> triangles;
  std::vector<Patch> patches;
  std::vector<Vector> corner_normals;  ///< 3 a triangle, of length 1, or (0,0,0) where unknown; or the whole list empty
  std::vector<std::array<Index, 2>> creases;  ///< sharp edges inside a patch, sorted: drawn, but no boundary

  /// The triangles of one patch.
  std::span<const Triangle> patch_triangles(std::size_t patch) const {
    return std::span(triangles).subspan(patches[patch].first_triangle, patches[patch].triangle_count);
  }
};

/// One occurrence of a shell in the model.
struct Instance {
  std::size_t shell = 0;        ///< index into Model::shells
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();  ///< shell frame to model frame; may mirror
  std::string path;             ///< product and shape ids from the root, joined by '/'
};

/// A line drawing that comes with the model (PMI, construction geometry), already placed in the model frame.
struct Polyline {
  std::string name;
  std::vector<Point> points;
};

/// A point of a curve with a right-handed frame: (normal, binormal, tangent) are of length 1 and perpendicular.
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

/// Everything that a file says. Shells are stored once however often they are placed.
struct Model {
  std::string name;
  double metres_per_unit = 0;  ///< 0: unknown
  bool has_patches = true;     ///< false: the file knows none, and one patch holds all triangles of a shell
  std::vector<Shell> shells;
  std::vector<Instance> instances;
  std::vector<Polyline> annotations;
  std::vector<NamedCurve> curves;
  std::vector<Diagnostic> diagnostics;
};

/// The box of the points that a triangle uses, in the shell's frame; empty for a shell without triangles.
Box bounding_box(const Shell& shell);

/// The box of all instances, annotations and curves (these by points, sixteen a span), in the model's frame.
Box bounding_box(const Model& model);

/// Checks what every stage relies on: indices in range, points finite, patches a partition of the triangles,
/// corner normals none or three a triangle, instances naming a shell.
///
/// @throws Error   Internal, naming the shell and what is wrong: a reader or a generator broke its promise.
void validate(const Model& model);

}  // namespace meshcontour

#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "meshcontour/curve.hpp"
#include "meshcontour/model.hpp"

namespace meshcontour {

/// How the normals of a space curve are carried along it.
enum class FrameMethod {
  RotationMinimizing,  ///< double reflection [Wang et al. 2008], the closing angle spread by arc length
  Projection,          ///< B_{i-1} x T_i, as a course assignment has it; the closing angle spread by index
  Frenet,              ///< towards the centre of curvature: flips at inflections, undefined on straight runs
};

struct SweepOptions {
  FrameMethod frames = FrameMethod::RotationMinimizing;
  bool caps = false;  ///< close the open ends of revolutions, and of cylinders whose profile is closed
  /// A profile or a sweep turns by more than this at a corner; radians, above 0 and at most pi.
  double corner_angle = 3 * std::numbers::pi / 180;
  std::uint64_t max_triangles = 200'000'000;  ///< of all surfaces together
  std::size_t max_frames = 1'000'000;  ///< of all curves together; those beyond get no NamedCurve::frames
  unsigned threads = 0;                ///< 0: one per processor
};

/// A curve to sweep along, to sweep or to revolve.
struct SweepCurve {
  enum class Kind {
    Bezier,   ///< chain of cubic Bezier pieces: 3k+1 control points, k >= 1
    BSpline,  ///< uniform cubic B-spline: 4 or more control points
    Circle,   ///< about the z axis, counter-clockwise from (radius, 0, 0)
  };

  std::string name;  ///< empty: anonymous
  Kind kind = Kind::Bezier;
  bool planar = true;                 ///< lies in the xy plane
  std::uint64_t steps = 1;            ///< samples a cubic piece, or of the whole circle, at least 1
  double radius = 0;                  ///< of a circle, model units, not negative
  std::vector<Point> control_points;  ///< none for a circle
  Spot spot;

  /// Cubic pieces; 1 for a circle.
  std::size_t pieces() const;
};

/// A surface made of curves.
struct SweepSurface {
  enum class Kind {
    Revolution,  ///< the profile turned about +y
    Cylinder,    ///< the profile carried along the sweep: x along the normal, y along the binormal
  };

  std::string name;  ///< empty: anonymous
  Kind kind = Kind::Revolution;
  std::uint64_t steps = 3;  ///< rings of a revolution, at least 3
  std::size_t profile = 0;  ///< index into SweepScene::curves; that curve is planar
  std::size_t sweep = 0;    ///< index into SweepScene::curves; of a cylinder only
  Spot spot;
};

/// All curves and surfaces of a file, in its order.
struct SweepScene {
  std::vector<SweepCurve> curves;
  std::vector<SweepSurface> surfaces;
};

/// A curve's samples with their frames.
struct FramedCurve {
  std::vector<CurveFrame> frames;  ///< pieces * steps + 1; where the curve has a corner, as it leaves it
  bool closed = false;             ///< the ends meet within 1e-9 of the size of the curve
  bool smooth = false;             ///< closed, and the tangents at the ends agree
  /// Of a smooth closed curve: from the last frame as it was carried to the first one, about the tangent;
  /// radians.
  double closing_angle = 0;
  double length = 0;  ///< arc length, model units
};

/// Samples a curve at steps equal parts of each piece, with a right-handed frame (normal, binormal, tangent)
/// at each.
///
/// Linear in the samples. Where the derivative vanishes the tangent is its one-sided limit; a curve that is a
/// single point has no frames, unless it is a circle. On plane curves the normal is left of the direction of
/// travel.
///
/// @throws Error  OutOfMemory if the samples are more than half of `max_triangles`.
FramedCurve frame_curve(const SweepCurve& curve, const SweepOptions& options = {});

/// The exact curve: a B-spline (a chain of Bezier pieces has inner knots of multiplicity 3), or a full
/// circular arc.
Curve to_curve(const SweepCurve& curve);

/// The surfaces as shells, one each and in order, and the curves as Model::curves with their frames.
///
/// Seams are welded by index, poles are single vertices with fans. A profile that touches or crosses the axis
/// is split there into parts with poles of their own. Closed parts are oriented outwards. A patch is one
/// smooth stretch of the profile (and of the sweep), a cap is a patch of its own. Linear in the triangles;
/// caps take O(n log n).
///
/// Diagnostics: surfaces without area (their shells stay empty), corners and cusps, self-intersection (the
/// profile reaches past the centre of curvature of the sweep), parts that coincide, closed sweeps with a
/// corner at the seam.
///
/// @throws Error  OutOfMemory if the surfaces need more than `max_triangles`; Usage if an option is out of
/// range.
Model sweep(const SweepScene& scene, const SweepOptions& options = {});

}  // namespace meshcontour

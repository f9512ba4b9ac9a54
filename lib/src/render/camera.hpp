#pragma once

#include <span>
#include <vector>

#include "meshcontour/render.hpp"
#include "render/scene.hpp"

namespace meshcontour::detail {

/// From model to clip coordinates, in double. Eye coordinates are about 1 in size; the viewer looks along -z.
struct Camera {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows: right, up, towards the viewer
  Point center = Point::Zero();  ///< of the model frame, at the origin of eye coordinates
  double scale = 1;              ///< eye units a model unit
  double distance = 0;           ///< of the centre before the viewer, eye units
  Eigen::Matrix4d projection = Eigen::Matrix4d::Identity();
  double pixels_per_unit = 1;  ///< of the model at the centre
};

/// A frame to be placed: local coordinates p stand for center + size p.
struct LocalFrame {
  Point center = Point::Zero();
  double size = 1;

  Eigen::Vector3f local(const Point& p) const { return ((p - center) / size).cast<float>(); }
};

/// The frame that takes a box to [-1, 1].
LocalFrame local_frame(const Box& box);

/// The matrix from local to eye coordinates, and whether it mirrors. The centre is subtracted before anything
/// is scaled or rounded, so that a model far from the origin keeps its digits.
Placement place(const Camera& camera, const LocalFrame& frame, const Eigen::Affine3d& placement);

/// The camera of the options' view; for all but Report so that the box, in axes of the view, fills the
/// picture but for a margin. An empty box, or a point, is seen at one unit's distance.
///
/// @param extent     of axes * (p - reference) over the points p of the model.
/// @param reference  a point of the model: far from the origin the differences are exact, the products would
/// not be.
/// @throws Error     BadData beyond 1e150.
Camera make_camera(const Box& extent, const Point& reference, const RenderOptions& options);

}  // namespace meshcontour::detail

#include "render/camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meshcontour {

namespace {

// Turns a model so that its up axis becomes Z; the axes keep their cyclic order, so that nothing is mirrored.
Eigen::Matrix3d z_up(UpAxis up) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (up == UpAxis::X) turn << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  if (up == UpAxis::Y) turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return turn;
}

Eigen::Matrix3d named_axes(View view) {
  const auto axes = [](const Vector& right, const Vector& up) {
    Eigen::Matrix3d rows;
    rows << right.transpose(), up.transpose(), right.cross(up).transpose();
    return rows;
  };
  const Vector x = Vector::UnitX(), y = Vector::UnitY(), z = Vector::UnitZ();
  switch (view) {
    case View::Front:
      return axes(x, z);
    case View::Back:
      return axes(-x, z);
    case View::Left:
      return axes(-y, z);
    case View::Right:
      return axes(y, z);
    case View::Top:
      return axes(x, y);
    case View::Bottom:
      return axes(x, -y);
    case View::Iso:
      return axes(Vector(1, 1, 0).normalized(), Vector(-1, 1, 2).normalized());
    case View::Report:
      break;
  }
  return Eigen::AngleAxisd(std::numbers::pi / 4, Vector(1, 1, -1).normalized()).toRotationMatrix();
}

}  // namespace

Eigen::Matrix3d view_axes(View view, UpAxis up) {
  return view == View::Report ? named_axes(view) : Eigen::Matrix3d(named_axes(view) * z_up(up));
}

namespace detail {
namespace {

constexpr double kLargest = 1e150;    // squares of lengths stay finite
constexpr double kMargin = 0.06;      // of the picture, on each side
constexpr double kDepthMargin = 0.2;  // eye units: curves bulge out of the box of their chords

// gluPerspective(30, width / height, 1, 1000).
Eigen::Matrix4d report_projection(const RenderOptions& options) {
  const double near = 1, far = 1000;
  const double f = 1 / std::tan(std::numbers::pi / 12);
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  projection(0, 0) = f * options.height / options.width;
  projection(1, 1) = f;
  projection(2, 2) = (far + near) / (near - far);
  projection(2, 3) = 2 * far * near / (near - far);
  projection(3, 2) = -1;
  return projection;
}

Camera report_camera(const RenderOptions& options) {
  Camera camera;
  camera.axes = view_axes(View::Report);
  camera.scale = 0.015;
  camera.distance = 4;
  camera.projection = report_projection(options);
  camera.pixels_per_unit = camera.projection(1, 1) * options.height / 2 / camera.distance * camera.scale;
  return camera;
}

}  // namespace

LocalFrame local_frame(const Box& box) {
  LocalFrame frame;
  if (box.isEmpty()) return frame;
  frame.center = box.min() / 2 + box.max() / 2;
  const double size = (box.max() - frame.center).maxCoeff();
  frame.size = size > 0 ? size : 1;
  return frame;
}

Placement place(const Camera& camera, const LocalFrame& frame, const Eigen::Affine3d& placement) {
  const Eigen::Matrix3d linear = camera.scale * camera.axes * placement.linear();
  const Vector shift = camera.scale * (camera.axes * (placement * frame.center - camera.center));
  Placement result;
  result.depth = shift.z() - camera.distance;
  result.to_eye = Eigen::Matrix4f::Identity();
  result.to_eye.topLeftCorner<3, 3>() = (linear * frame.size).cast<float>();
  result.to_eye.topRightCorner<3, 1>() = Vector(shift.x(), shift.y(), result.depth).cast<float>();
  result.mirrored = placement.linear().determinant() < 0;
  return result;
}

Camera make_camera(const Box& extent, const Point& reference, const RenderOptions& options) {
  if (options.view == View::Report) return report_camera(options);
  Camera camera;
  camera.axes = view_axes(options.view, options.up);
  Vector half = Vector::Zero();
  if (!extent.isEmpty()) {
    if (extent.min().cwiseAbs().maxCoeff() > kLargest || extent.max().cwiseAbs().maxCoeff() > kLargest) {
      throw Error(ErrorCode::BadData, "the model's coordinates are beyond 1e150: too large to be drawn");
    }
    half = extent.sizes() / 2;
    camera.center = reference + camera.axes.transpose() * extent.center();
  }
  const double size = half.maxCoeff() > 1 / kLargest ? half.maxCoeff() : 0.5;
  camera.scale = 1 / size;
  half /= size;
  const double usable = 1 - 2 * kMargin;
  const double aspect = static_cast<double>(options.width) / options.height;
  const double fitted = std::max(half.x() / aspect, half.y());
  const double half_height = (fitted > 0 ? fitted : 1) / usable;
  const double depth = half.z() + kDepthMargin;
  camera.projection =
      Eigen::Vector4d(1 / (half_height * aspect), 1 / half_height, -1 / depth, 1).asDiagonal();
  camera.pixels_per_unit = options.height / 2.0 / half_height * camera.scale;
  return camera;
}

}  // namespace detail
}  // namespace meshcontour

#include "render/shading.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace meshcontour::detail {
namespace {

constexpr float kAmbient = 0.36F, kDiffuse = 0.64F;

Eigen::Vector3f position_of(const Vertex& vertex) {
  return Eigen::Map<const Eigen::Vector3f>(vertex.position.data());
}

ShadedVertex shaded_vertex(const Vertex& vertex, float intensity) {
  const auto channel = [&](std::uint8_t level) { return static_cast<float>(level) / 255 * intensity; };
  const Rgba& color = vertex.color;
  return {
      vertex.position,
      {channel(color.red), channel(color.green), channel(color.blue), static_cast<float>(color.alpha) / 255}};
}

// The matrix of cofactors turns normals also where there is no inverse; scaled so that nothing overflows.
Eigen::Matrix3d cofactors(const Eigen::Matrix3d& m) {
  const double largest = m.cwiseAbs().maxCoeff();
  const Eigen::Matrix3d scaled = largest > 0 ? Eigen::Matrix3d(m / largest) : m;
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i) {
    result.row(i) = scaled.row((i + 1) % 3).cross(scaled.row((i + 2) % 3));
  }
  return result;
}

}  // namespace

FaceLight::FaceLight(const Placement& placement, bool perspective)
    : linear_(placement.to_eye.topLeftCorner<3, 3>()),
      shift_(placement.to_eye.topRightCorner<3, 1>()),
      perspective_(perspective) {
  normals_ = cofactors(linear_.cast<double>()).cast<float>();
  if (placement.mirrored) normals_ = -normals_;
}

bool FaceLight::seen_from_front(const Vertex* corners) const {
  const Eigen::Vector3f a = position_of(corners[0]);
  const Eigen::Vector3f normal = normals_ * (position_of(corners[1]) - a).cross(position_of(corners[2]) - a);
  return perspective_ ? normal.dot(linear_ * a + shift_) < 0 : normal.z() > 0;
}

float FaceLight::intensity(const Vertex& corner, bool front) const {
  static const Eigen::Vector3f towards = Eigen::Vector3f(-0.25F, 0.35F, 1).normalized();
  const Eigen::Vector3f normal =
      normals_ * Eigen::Vector3f(corner.normal[0], corner.normal[1], corner.normal[2]);
  const float length = normal.norm();
  const float cosine = length > 0 ? normal.dot(towards) / length : 0;
  return kAmbient + kDiffuse * std::max(front ? cosine : -cosine, 0.0F);
}

void FaceLight::shade(std::span<const Vertex> corners, std::span<ShadedVertex> shaded) const {
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const bool front = seen_from_front(&corners[i]);
    for (std::size_t c = i; c < i + 3; ++c)
      shaded[c] = shaded_vertex(corners[c], intensity(corners[c], front));
  }
}

void keep_colors(std::span<const Vertex> vertices, std::span<ShadedVertex> shaded) {
  std::ranges::transform(vertices, shaded.begin(),
                         [](const Vertex& vertex) { return shaded_vertex(vertex, 1); });
}

}  // namespace meshcontour::detail

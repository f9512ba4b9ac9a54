#include <array>

#include "render/layers.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kAxisShare = 0.04;
constexpr Rgba kNormalColor{220, 40, 40, 255}, kBinormalColor{30, 150, 60, 255},
    kTangentColor{40, 80, 220, 255};

}  // namespace

double frame_axis_length(const Model& model) {
  Box box;
  for (const NamedCurve& curve : model.curves) {
    for (const CurveFrame& frame : curve.frames) box.extend(frame.position);
  }
  return box.isEmpty() ? 0 : kAxisShare * box.diagonal().norm();
}

void add_frames(const Drawing& drawing, Scene& scene) {
  const std::size_t last = drawing.frames.size() - 1;
  const double length = frame_axis_length(drawing.model);
  std::vector<Vertex> vertices;
  const auto add = [&](const Point& from, const Vector& axis, const Rgba& color) {
    vertices.push_back(flat_vertex(drawing.frames[last], from, color));
    vertices.push_back(flat_vertex(drawing.frames[last], from + length * axis, color));
  };
  for (const NamedCurve& curve : drawing.model.curves) {
    for (const CurveFrame& frame : curve.frames) {
      add(frame.position, frame.normal, kNormalColor);
      add(frame.position, frame.binormal, kBinormalColor);
      add(frame.position, frame.tangent, kTangentColor);
    }
  }
  append(scene, make_batch(drawing, Batch::Kind::Lines, last, 1), vertices);
}

}  // namespace meshcontour::detail

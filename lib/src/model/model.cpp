#include "meshcontour/model.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace meshcontour {
namespace {

void require(bool holds, const Shell& shell, std::string_view what) {
  if (!holds) throw Error(ErrorCode::Internal, fmt::format("shell {}: {}", printable(shell.id), what));
}

void validate(const Shell& shell) {
  const auto in_range = [&](const Triangle& t) { return std::ranges::max(t) < shell.points.size(); };
  require(std::ranges::all_of(shell.triangles, in_range), shell,
          "a triangle names a point that does not exist");
  const auto finite = [](const Point& p) { return p.allFinite(); };
  require(std::ranges::all_of(shell.points, finite), shell, "a point is not finite");
  require(shell.corner_normals.empty() || shell.corner_normals.size() == 3 * shell.triangles.size(), shell,
          "the corner normals are not three a triangle");
  require(shell.point_colors.empty() || shell.point_colors.size() == shell.points.size(), shell,
          "the colours are not one a point");
  require(shell.texture_coordinates.empty() || shell.texture_coordinates.size() == shell.points.size(), shell,
          "the texture coordinates are not one a point");
  std::size_t next = 0;
  for (const Patch& patch : shell.patches) {
    require(patch.first_triangle == next, shell, "the patches are not a partition of the triangles");
    next += patch.triangle_count;
  }
  require(next == shell.triangles.size(), shell, "the patches are not a partition of the triangles");
}

// Points of the curve, a sixteenth of a span apart.
void extend(Box& box, const Curve& curve) {
  constexpr int kParts = 16;
  const BSplineCurve spline = to_clamped_bspline(curve);
  const auto& knots = spline.knots;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    if (knots[i] == knots[i + 1]) continue;
    for (int k = 0; k <= kParts; ++k) {
      box.extend(evaluate(spline, knots[i] + (knots[i + 1] - knots[i]) * k / kParts));
    }
  }
}

}  // namespace

Box bounding_box(const Shell& shell) {
  Box box;
  for (const Triangle& triangle : shell.triangles) {
    for (const Index v : triangle) box.extend(shell.points[v]);
  }
  return box;
}

Box bounding_box(const Model& model) {
  std::vector<Box> boxes;
  for (const Shell& shell : model.shells) boxes.push_back(bounding_box(shell));
  Box box;
  for (const Instance& instance : model.instances) {
    const Box& part = boxes[instance.shell];
    if (part.isEmpty()) continue;
    for (int corner = 0; corner < 8; ++corner) {
      box.extend(instance.placement * part.corner(static_cast<Box::CornerType>(corner)));
    }
  }
  for (const Polyline& line : model.annotations) {
    for (const Point& p : line.points) box.extend(p);
  }
  for (const NamedCurve& named : model.curves) extend(box, named.curve);
  return box;
}

void validate(const Model& model) {
  for (const Shell& shell : model.shells) validate(shell);
  for (const Instance& instance : model.instances) {
    if (instance.shell >= model.shells.size()) {
      throw Error(ErrorCode::Internal, "an instance names a shell that does not exist");
    }
  }
}

}  // namespace meshcontour

#include "read/polygon_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "meshcontour/cleaning.hpp"
#include "meshcontour/segmentation.hpp"
#include "meshcontour/welding.hpp"
#include "model/triangulate.hpp"

namespace meshcontour::detail {
namespace {

Vector unit_or_zero(const Vector& normal) {
  const double length = normal.stableNorm();
  return length > 0 ? Vector(normal / length) : Vector(Vector::Zero());
}

}  // namespace

PolygonMesh::PolygonMesh(const ReadContext& context) : context_(context) {
  shell_.id = "mesh";
}

void PolygonMesh::note(Diagnostic::Severity severity, const std::string& message, const Spot& spot,
                       std::size_t count) {
  const auto same = [&](const Diagnostic& d) { return d.message == message; };
  if (const auto known = std::ranges::find_if(diagnostics_, same); known != diagnostics_.end()) {
    known->count += count;
    return;
  }
  diagnostics_.push_back({severity, message, spot, count});
  if (spot.file.empty()) diagnostics_.back().spot.file = context_.name;
}

void PolygonMesh::add_triangle(const Triangle& triangle, Index group) {
  if (shell_.triangles.size() >= context_.options.max_triangles) {
    throw Error(ErrorCode::OutOfMemory,
                fmt::format("more than {} triangles, the limit", context_.options.max_triangles),
                {context_.name, 0, 0, ""});
  }
  if (group != 0 || !triangle_groups_.empty()) {
    triangle_groups_.resize(shell_.triangles.size(), 0);
    triangle_groups_.push_back(group);
  }
  shell_.triangles.push_back(triangle);
}

void PolygonMesh::add_polygon(std::span<const Index> corners, std::span<const Index> corner_normals,
                              Index group) {
  if (corners.size() < 3) {
    return note(Diagnostic::Severity::Warning, "polygon with fewer than three corners, left out");
  }
  if (!triangulate(points, corners, cut_)) {
    note(Diagnostic::Severity::Warning,
         "polygon that crosses itself or has no area, cut into a fan of triangles");
  }
  for (const auto& [a, b, c] : cut_) {
    if (!corner_normals.empty() || !shell_.corner_normals.empty()) {
      shell_.corner_normals.resize(3 * shell_.triangles.size(), Vector::Zero());
      for (const std::uint32_t k : {a, b, c}) {
        const bool known = !corner_normals.empty();
        shell_.corner_normals.push_back(known ? unit_or_zero(normals[corner_normals[k]]) : Vector::Zero());
      }
    }
    add_triangle({corners[a], corners[b], corners[c]}, group);
  }
}

void PolygonMesh::make_patches() {
  if (triangle_groups_.empty()) {
    merge_patches(shell_);
    if (groups.size() == 1) shell_.patches[0].color = shell_.color = groups[0].color;
    return;
  }
  const std::vector<Index> group_of_patch = group_triangles(shell_, triangle_groups_);
  for (std::size_t p = 0; p < group_of_patch.size(); ++p) {
    shell_.patches[p].name = groups[group_of_patch[p]].name;
    shell_.patches[p].color = groups[group_of_patch[p]].color;
  }
}

void PolygonMesh::weld() {
  if (!context_.options.weld) return;
  const std::size_t gone = weld_points(shell_, *context_.options.weld);
  if (gone > 0) note(Diagnostic::Severity::Note, "points welded", {}, gone);
}

Model PolygonMesh::finish() && {
  shell_.points = std::move(points);
  shell_.point_colors = std::move(point_colors);
  shell_.texture_coordinates = std::move(texture_coordinates);
  make_patches();
  weld();
  const Spot spot{context_.name, 0, 0, ""};
  if (shell_.triangles.empty()) note(Diagnostic::Severity::Note, "no triangles");
  clean_shell(shell_, spot, diagnostics_, context_.options.threads);
  Model model;
  model.has_patches = shell_.patches.size() > 1;
  model.shells.push_back(std::move(shell_));
  model.instances.push_back({0, Eigen::Affine3d::Identity(), ""});
  model.diagnostics = std::move(diagnostics_);
  return model;
}

}  // namespace meshcontour::detail

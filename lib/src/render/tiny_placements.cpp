#include "render/tiny_placements.hpp"

#include <algorithm>
#include <cmath>

namespace meshcontour::detail {
namespace {

constexpr std::size_t kMany = 1000;    // placements; fewer cost nothing
constexpr double kTiny = 0.25;         // samples
constexpr double kRounding = 1 / 32.;  // samples: the rasterizer's grid is finer

// Where a placed box lies, in samples from the lower left corner of the picture.
struct Footprint {
  double x, y, half_width, half_height;

  // Whether faces can have a fragment: whether the centre of a sample lies in the box.
  bool holds_sample() const { return between(x, half_width) && between(y, half_height); }
  bool tiny() const { return 2 * half_width <= kTiny && 2 * half_height <= kTiny; }

 private:
  static bool between(double middle, double half) {
    const double reach = half + kRounding;
    return std::floor(middle + reach - 0.5) >= middle - reach - 0.5;
  }
};

class Footprints {
 public:
  explicit Footprints(const Scene& scene)
      : projection_(scene.projection),
        size_(scene.samples_across / 2.0 * Eigen::Vector2d(scene.width, scene.height)) {}

  Footprint of(const Placement& placement, const Eigen::Vector3d& extent) const {
    const Eigen::Matrix4d to_clip = projection_ * placement.to_eye.cast<double>();
    const Eigen::Vector2d middle = (to_clip.topRightCorner<2, 1>().array() + 1).matrix().cwiseProduct(size_);
    const Eigen::Vector2d half = (to_clip.topLeftCorner<2, 3>().cwiseAbs() * extent).cwiseProduct(size_);
    return {middle.x(), middle.y(), half.x(), half.y()};
  }

 private:
  Eigen::Matrix4d projection_;
  Eigen::Vector2d size_;  // half the samples of the picture
};

// A tiny placement among those of its cell.
struct Candidate {
  double column, row, depth;
  std::size_t index;

  bool same_cell(const Candidate& other) const { return column == other.column && row == other.row; }
  bool operator<(const Candidate& other) const {
    if (!same_cell(other)) return std::pair(column, row) < std::pair(other.column, other.row);
    return depth != other.depth ? depth > other.depth : index > other.index;
  }
};

// What a frame's placements are to faces, to lines, and as dots; in their order.
struct Parts {
  std::vector<Placement> faces, lines, dots;
};

std::vector<bool> nearest_of_cells(std::vector<Candidate>& candidates, std::size_t placements) {
  std::vector<bool> nearest(placements, false);
  std::ranges::sort(candidates, std::less<>());
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (k == 0 || !candidates[k].same_cell(candidates[k - 1])) nearest[candidates[k].index] = true;
  }
  return nearest;
}

Parts parts_of(const std::vector<Placement>& placements, const Footprints& footprints,
               const Eigen::Vector3d& extent) {
  Parts parts;
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < placements.size(); ++i) {
    const Footprint footprint = footprints.of(placements[i], extent);
    if (footprint.holds_sample()) parts.faces.push_back(placements[i]);
    if (footprint.tiny()) {
      candidates.push_back(
          {std::floor(footprint.x / kTiny), std::floor(footprint.y / kTiny), placements[i].depth, i});
    } else {
      parts.lines.push_back(placements[i]);
    }
  }
  const std::vector<bool> nearest = nearest_of_cells(candidates, placements.size());
  for (std::size_t i = 0; i < placements.size(); ++i) {
    if (nearest[i]) parts.dots.push_back(placements[i]);
  }
  return parts;
}

// What stands for a batch of lines or points.
Batch dot_for(const Batch& batch, std::size_t frame, std::vector<Vertex>& vertices) {
  Batch dot;
  dot.kind = Batch::Kind::Points;
  dot.frame = frame;
  dot.size = batch.size;
  dot.bias = batch.bias;
  dot.range.first = vertices.size();
  dot.range.count = 1;
  vertices.push_back(
      {.position = {},
       .color = batch.range.count > 0 ? vertices[batch.range.first].color : batch.runs[0].color});
  return dot;
}

// The frame keeps the placements of its lines; two more frames follow.
void split(Scene& scene, std::size_t frame, Parts&& parts) {
  const std::size_t faces = scene.frames.size(), dots = faces + 1;
  scene.frames[frame] = std::move(parts.lines);
  scene.frames.push_back(std::move(parts.faces));
  scene.frames.push_back(std::move(parts.dots));
  std::vector<Batch> batches;
  for (Batch& batch : scene.batches) {
    const bool here = batch.frame == frame, triangles = batch.kind == Batch::Kind::Triangles;
    if (here && triangles) batch.frame = faces;
    batches.push_back(std::move(batch));
    if (here && !triangles) batches.push_back(dot_for(batches.back(), dots, scene.vertices));
  }
  scene.batches = std::move(batches);
}

}  // namespace

void leave_out_tiny(Scene& scene, const std::vector<Eigen::Vector3d>& extents) {
  if (scene.perspective()) return;
  const Footprints footprints(scene);
  for (std::size_t frame = 0; frame < extents.size(); ++frame) {
    if (scene.frames[frame].size() < kMany || extents[frame].isZero()) continue;
    split(scene, frame, parts_of(scene.frames[frame], footprints, extents[frame]));
  }
}

}  // namespace meshcontour::detail

#include "render/drawn_region.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace meshcontour::detail {
namespace {

constexpr int kBlock = 64;                        // samples; llvmpipe's own tiles are as large
constexpr std::size_t kMostPlacements = 100'000;  // more take too long
constexpr double kNearestDistance = 1e-3;         // eye units
constexpr double kRounding = 2;                   // samples

// What is drawn in a frame.
struct Content {
  Eigen::AlignedBox3f box;
  double least_bias = 0, largest_bias = 0;
  double half_width = 0;  // of its lines and points, samples

  void add(const std::vector<Vertex>& vertices, const VertexRange& range) {
    for (std::size_t v = range.first; v < range.first + range.count; ++v) {
      box.extend(Eigen::Map<const Eigen::Vector3f>(vertices[v].position.data()));
    }
  }
};

std::vector<Content> contents_of(const Scene& scene) {
  std::vector<Content> contents(scene.frames.size());
  for (const Batch& batch : scene.batches) {
    Content& content = contents[batch.frame];
    content.add(scene.vertices, batch.range);
    content.add(scene.vertices, batch.chords);
    content.least_bias = std::min(content.least_bias, batch.bias);
    content.largest_bias = std::max(content.largest_bias, batch.bias);
    if (batch.kind != Batch::Kind::Triangles) {
      content.half_width = std::max(content.half_width, scene.samples_across / 2.0 * batch.size);
    }
  }
  return contents;
}

// The rectangle that grows by what is drawn, in samples.
class Cover {
 public:
  explicit Cover(const Scene& scene)
      : projection_(scene.projection),
        size_(scene.samples_across * Eigen::Vector2d(scene.width, scene.height)),
        perspective_(scene.perspective()) {}

  void add(const Content& content, const Placement& placement) {
    Eigen::AlignedBox2d part;
    for (const double bias : {content.least_bias, content.largest_bias}) {
      Eigen::Matrix4d to_eye = placement.to_eye.cast<double>();
      to_eye(2, 3) = placement.depth + bias;
      const Eigen::Matrix<double, 4, 4> to_clip = projection_ * to_eye;
      if (perspective_) {
        add_corners(to_clip, content.box, part);
      } else {
        add_affine(to_clip, content.box, part);
      }
    }
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(content.half_width + kRounding);
    box_.extend(Eigen::Vector2d(part.min() - reach));
    box_.extend(Eigen::Vector2d(part.max() + reach));
    unbounded_ = unbounded_ || !part.min().allFinite() || !part.max().allFinite();
  }

  void add_everything() { unbounded_ = true; }

  Region region() const {
    if (unbounded_) return {0, 0, static_cast<int>(size_.x()), static_cast<int>(size_.y())};
    if (box_.isEmpty()) return {};
    const auto blocks = [](double samples) { return kBlock * static_cast<int>(samples / kBlock); };
    const Eigen::Vector2d low = box_.min().cwiseMax(0).cwiseMin(size_),
                          high = box_.max().cwiseMax(0).cwiseMin(size_);
    return {blocks(low.x()), blocks(low.y()),
            std::min(blocks(high.x()) + kBlock, static_cast<int>(size_.x())),
            std::min(blocks(high.y()) + kBlock, static_cast<int>(size_.y()))};
  }

 private:
  Eigen::Vector2d samples(const Eigen::Vector2d& clip) const {
    return ((clip.array() + 1) / 2).matrix().cwiseProduct(size_);
  }

  void add_affine(const Eigen::Matrix4d& to_clip, const Eigen::AlignedBox3f& box,
                  Eigen::AlignedBox2d& part) const {
    const Eigen::Vector3d middle = box.center().cast<double>(), half = (box.max().cast<double>() - middle);
    const Eigen::Vector2d center = to_clip.topLeftCorner<2, 3>() * middle + to_clip.topRightCorner<2, 1>();
    const Eigen::Vector2d reach = to_clip.topLeftCorner<2, 3>().cwiseAbs() * half;
    part.extend(samples(center - reach));
    part.extend(samples(center + reach));
  }

  void add_corners(const Eigen::Matrix4d& to_clip, const Eigen::AlignedBox3f& box,
                   Eigen::AlignedBox2d& part) {
    for (int i = 0; i < 8; ++i) {
      const auto corner = static_cast<Eigen::AlignedBox3f::CornerType>(i);
      const Eigen::Vector4d clip = to_clip * box.corner(corner).cast<double>().homogeneous();
      if (!(clip.w() > kNearestDistance)) return add_everything();
      part.extend(samples(clip.head<2>() / clip.w()));
    }
  }

  Eigen::Matrix4d projection_;
  Eigen::Vector2d size_;
  bool perspective_, unbounded_ = false;
  Eigen::AlignedBox2d box_;
};

}  // namespace

Region drawn_region(const Scene& scene) {
  std::size_t placements = 0;
  for (const auto& frame : scene.frames) placements += frame.size();
  Cover cover(scene);
  if (placements > kMostPlacements) cover.add_everything();
  const std::vector<Content> contents = contents_of(scene);
  for (std::size_t f = 0; f < contents.size() && placements <= kMostPlacements; ++f) {
    if (contents[f].box.isEmpty()) continue;
    for (const Placement& placement : scene.frames[f]) cover.add(contents[f], placement);
  }
  return cover.region();
}

}  // namespace meshcontour::detail

#include "multires/vertex_quadrics.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kSharpWeight = 10;  // of a plane through a sharp edge, beside one of a triangle

class Sum {
 public:
  Sum(const CollapseMesh& mesh, const Point& centre)
      : mesh_(mesh), centre_(centre), quadrics_(mesh.vertex_count()) {
    for (Index h = 0; h < mesh.halfedge_count(); h += 3) add(h);
  }

  std::vector<Quadric> take() { return std::move(quadrics_); }

 private:
  Point local(Index v) const { return mesh_.point(v) - centre_; }

  // Of the triangle whose first halfedge it is.
  void add(Index first) {
    const Point a = local(mesh_.start(first)), b = local(mesh_.start(first + 1)),
                c = local(mesh_.start(first + 2));
    const Vector cross = (b - a).cross(c - a);
    const double area = cross.norm() / 2;
    if (!(area > 0)) return;
    const Vector normal = cross / (2 * area);
    Quadric plane;
    plane.add_plane(normal, a, area);
    plane.weight = area;
    for (Index h = first; h < first + 3; ++h) {
      quadrics_[mesh_.start(h)] += plane;
      if (mesh_.is_sharp(h)) add_sharp(h, normal);
    }
  }

  // The plane through a sharp edge that stands upright on its triangle.
  void add_sharp(Index h, const Vector& normal) {
    const Vector edge = local(mesh_.end(h)) - local(mesh_.start(h));
    const double length = edge.norm();
    if (!(length > 0)) return;
    Quadric plane;
    plane.add_plane(edge.cross(normal) / length, local(mesh_.start(h)), kSharpWeight * length * length);
    quadrics_[mesh_.start(h)] += plane;
    quadrics_[mesh_.end(h)] += plane;
  }

  const CollapseMesh& mesh_;
  const Point& centre_;
  std::vector<Quadric> quadrics_;
};

}  // namespace

Point box_centre(const Shell& shell) {
  const Box box = bounding_box(shell);
  return box.isEmpty() ? Point(Point::Zero()) : Point(box.center());
}

std::vector<Quadric> vertex_quadrics(const CollapseMesh& mesh, const Point& centre) {
  return Sum(mesh, centre).take();
}

}  // namespace meshcontour::detail

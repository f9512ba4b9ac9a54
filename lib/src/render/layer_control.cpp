#include <variant>

#include "meshcontour/fit.hpp"
#include "render/layers.hpp"

namespace meshcontour::detail {
namespace {

// What defines the curves of one shell: polygons, control points, and the joints and knots on the curves.
struct ControlVertices {
  std::vector<Vertex> polygons, points, knots;
};

struct ControlShapes {
  const LocalFrame& frame;
  const Palette& palette;
  ControlVertices& vertices;

  void knot(const Point& p) const { vertices.knots.push_back(flat_vertex(frame, p, palette.knots)); }

  // Lines and arcs are known by their ends, arcs by their centres too.
  void operator()(const LineSegment& line) const {
    knot(line.start);
    knot(line.end);
  }
  void operator()(const CircularArc& arc) const { ends_and_center(arc.start, arc.end, arc.center); }
  void operator()(const EllipticalArc& arc) const { ends_and_center(arc.start, arc.end, arc.center); }

  void operator()(const BSplineCurve& curve) const {
    const auto& points = curve.control_points;
    const auto degree = static_cast<std::size_t>(curve.degree);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vertex vertex = flat_vertex(frame, points[i], palette.control);
      if (i > 0) vertices.polygons.push_back(vertex);
      if (i + 1 < points.size()) vertices.polygons.push_back(vertex);
      if (!curve.periodic || i + degree < points.size()) vertices.points.push_back(vertex);
    }
    for (std::size_t i = degree; i <= points.size(); ++i) {
      if (i == degree || curve.knots[i] > curve.knots[i - 1]) knot(evaluate(curve, curve.knots[i]));
    }
  }

 private:
  void ends_and_center(const Point& start, const Point& end, const Point& center) const {
    knot(start);
    knot(end);
    vertices.points.push_back(flat_vertex(frame, center, palette.control));
  }
};

}  // namespace

void add_control(const Drawing& drawing, Scene& scene) {
  const auto repeated = repeated_segments(drawing.contours);
  for (std::size_t c = 0; c < drawing.contours.size();) {
    const std::size_t shell = drawing.contours[c].shell;
    ControlVertices vertices;
    const ControlShapes shapes{drawing.frames[shell], drawing.palette, vertices};
    for (; c < drawing.contours.size() && drawing.contours[c].shell == shell; ++c) {
      const auto& segments = drawing.contours[c].segments;
      for (std::size_t i = 0; i < segments.size(); ++i) {
        if (!repeated[c][i] && placed(drawing, shell)) std::visit(shapes, segments[i].curve);
      }
    }
    append(scene, make_batch(drawing, Batch::Kind::Lines, shell, 1), vertices.polygons);
    append(scene, make_batch(drawing, Batch::Kind::Points, shell, 5), vertices.points);
    append(scene, make_batch(drawing, Batch::Kind::Points, shell, 3), vertices.knots);
  }
}

}  // namespace meshcontour::detail

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_set>

#include "base/timestamp.hpp"
#include "write/drawing.hpp"
#include "write/dxf_file.hpp"
#include "write/sampling.hpp"
#include "write/units.hpp"
#include "write/writers.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kFlatness = 1e-6;        // of its size, for a loop that is written as a plane polyline
constexpr double kChordTolerance = 1e-4;  // of its size, for curves that become chords
constexpr double kThinnest = 1e-6;        // axis ratio of an ELLIPSE that all readers take

// Object coordinates: x and y axes that follow from the normal alone (the "arbitrary axis algorithm").
struct ObjectFrame {
  explicit ObjectFrame(const Vector& n) : normal(n) {
    const bool near_z = std::abs(n.x()) < 1.0 / 64 && std::abs(n.y()) < 1.0 / 64;
    x = (near_z ? Vector::UnitY() : Vector::UnitZ()).cross(n).normalized();
    y = n.cross(x);
  }

  Point of(const Point& p) const { return {p.dot(x), p.dot(y), p.dot(normal)}; }
  double angle(const Vector& v) const { return std::atan2(v.dot(y), v.dot(x)); }

  Vector normal, x, y;
};

double degrees(double radians) {
  const double angle = radians * 360 / kTurn;
  return angle < 0 ? angle + 360 : angle;
}

class DxfWriter {
 public:
  DxfWriter(Sink& sink, bool polylines) : file_(sink), polylines_(polylines) {}

  DxfFile& file() { return file_; }
  void add(const Group& group);
  void add_notes(std::vector<Diagnostic>& notes) const;

 private:
  void add(const Chain& chain);
  void entity(const LineSegment& line);
  void entity(const CircularArc& arc);
  void entity(const EllipticalArc& arc);
  void entity(const BSplineCurve& spline);
  void plane_polyline(const Chain& chain, const Plane& plane);
  void space_polyline(const Chain& chain);
  std::optional<Plane> plane_of_chain(const Chain& chain) const;

  DxfFile file_;
  bool polylines_;
  std::string layer_;
  std::size_t chorded_ = 0, not_flat_ = 0;
};

void DxfWriter::entity(const LineSegment& line) {
  file_.entity("LINE", layer_);
  file_.marker("AcDbLine");
  file_.point(10, line.start);
  file_.point(11, line.end);
}

// Counter-clockwise about a normal towards +z where possible: old readers ignore the normal.
void DxfWriter::entity(const CircularArc& given) {
  const bool turned = upward(given.axis) != given.axis;
  const CircularArc arc = turned ? std::get<CircularArc>(reversed(Curve(given))) : given;
  const ObjectFrame frame(arc.axis);
  file_.entity(arc.full() ? "CIRCLE" : "ARC", layer_);
  file_.marker("AcDbCircle");
  file_.point(10, frame.of(arc.center));
  file_.real(40, arc.radius);
  file_.point(210, arc.axis);
  if (arc.full()) return;
  const double first = frame.angle(arc.start - arc.center);
  file_.marker("AcDbArc");
  file_.real(50, degrees(first));
  file_.real(51, std::fmod(degrees(first + arc.angle), 360));
}

void DxfWriter::entity(const EllipticalArc& arc) {
  if (arc.ratio < kThinnest) return entity(to_clamped_bspline(arc));
  const double first = arc.full() ? 0 : arc.start_parameter(), last = first + arc.angle;
  file_.entity("ELLIPSE", layer_);
  file_.marker("AcDbEllipse");
  file_.point(10, arc.center);
  file_.point(11, arc.major);
  file_.point(210, arc.axis);
  file_.real(40, arc.ratio);
  file_.real(41, first);
  file_.real(42, last > kTurn ? last - kTurn : last);
}

void DxfWriter::entity(const BSplineCurve& given) {
  const BSplineCurve spline = to_clamped_bspline(given);
  const Chain chain{"", false, {}, spline.control_points};
  const auto plane = plane_of(spline.control_points, kFlatness * chain_size(chain));
  const bool rational = !spline.weights.empty();
  file_.entity("SPLINE", layer_);
  file_.marker("AcDbSpline");
  if (plane) file_.point(210, plane->normal);
  file_.value(70, (plane ? 8 : 0) + (rational ? 4 : 0));
  file_.value(71, spline.degree);
  file_.value(72, static_cast<long long>(spline.knots.size()));
  file_.value(73, static_cast<long long>(spline.control_points.size()));
  file_.value(74, 0);
  for (const double knot : spline.knots) file_.real(40, knot);
  for (std::size_t i = 0; i < spline.control_points.size(); ++i) {
    if (rational) file_.real(41, spline.weights[i]);
    file_.point(10, spline.control_points[i]);
  }
}

// A vertex of a plane polyline and the arc that follows it: the tangent of a quarter of its angle.
struct Vertex {
  Point point;
  double bulge = 0;
};

void add_vertices(const CircularArc& arc, const Plane& plane, std::vector<Vertex>& vertices) {
  const double side = arc.axis.dot(plane.normal) > 0 ? 1 : -1;
  const int pieces = arc.angle > std::numbers::pi ? 2 : 1;  // a bulge grows without bound towards a full turn
  const double bulge = side * std::tan(arc.angle / pieces / 4);
  vertices.push_back({arc.start, bulge});
  if (pieces == 2) vertices.push_back({evaluate(Curve(arc), 0.5), bulge});
}

std::vector<Vertex> vertices_of(const Chain& chain, const Plane& plane) {
  std::vector<Vertex> vertices;
  for (const Point& p : chain.points) vertices.push_back({p});
  const double tolerance = kChordTolerance * chain_size(chain);
  for (const Curve& curve : chain.curves) {
    if (const auto* arc = std::get_if<CircularArc>(&curve)) {
      add_vertices(*arc, plane, vertices);
      continue;
    }
    const std::vector<Point> points = sampled(curve, tolerance);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) vertices.push_back({points[i]});
  }
  if (!chain.closed && !chain.curves.empty()) vertices.push_back({end_of(chain.curves.back())});
  return vertices;
}

void DxfWriter::plane_polyline(const Chain& chain, const Plane& plane) {
  const std::vector<Vertex> vertices = vertices_of(chain, plane);
  const ObjectFrame frame(plane.normal);
  file_.entity("LWPOLYLINE", layer_);
  file_.marker("AcDbPolyline");
  file_.value(90, static_cast<long long>(vertices.size()));
  file_.value(70, chain.closed ? 1 : 0);
  file_.real(38, plane.origin.dot(plane.normal));
  for (const Vertex& vertex : vertices) {
    const Point p = frame.of(vertex.point);
    file_.real(10, p.x());
    file_.real(20, p.y());
    if (vertex.bulge != 0) file_.real(42, vertex.bulge);
  }
  file_.point(210, plane.normal);
}

void DxfWriter::space_polyline(const Chain& chain) {
  const Handle polyline = file_.entity("POLYLINE", layer_);
  file_.marker("AcDb3dPolyline");
  file_.value(66, 1);
  file_.point(10, Point::Zero());
  file_.value(70, chain.closed ? 9 : 8);
  for (const Point& p : chain_points(chain, kChordTolerance * chain_size(chain))) {
    file_.entity("VERTEX", layer_, polyline);
    file_.marker("AcDbVertex");
    file_.marker("AcDb3dPolylineVertex");
    file_.point(10, p);
    file_.value(70, 32);
  }
  file_.entity("SEQEND", layer_, polyline);
}

std::optional<Plane> DxfWriter::plane_of_chain(const Chain& chain) const {
  const double size = chain_size(chain);
  const auto plane = plane_of(chain_points(chain, kChordTolerance * size), kFlatness * size);
  const auto fits = [&](const Curve& curve) {
    const auto* arc = std::get_if<CircularArc>(&curve);
    return arc == nullptr || arc->axis.cross(plane->normal).norm() * arc->radius <= kFlatness * size;
  };
  return plane && std::ranges::all_of(chain.curves, fits) ? plane : std::nullopt;
}

void DxfWriter::add(const Chain& chain) {
  if (!polylines_ && chain.points.empty()) {
    for (const Curve& curve : chain.curves) {
      std::visit([&](const auto& c) { entity(c); }, curve);
    }
    return;
  }
  const auto plane = plane_of_chain(chain);
  const auto is_chorded = [&](const Curve& curve) {
    return std::holds_alternative<EllipticalArc>(curve) || std::holds_alternative<BSplineCurve>(curve) ||
           (!plane && std::holds_alternative<CircularArc>(curve));
  };
  chorded_ += static_cast<std::size_t>(std::ranges::count_if(chain.curves, is_chorded));
  if (!plane && polylines_) ++not_flat_;
  plane ? plane_polyline(chain, *plane) : space_polyline(chain);
}

void DxfWriter::add(const Group& group) {
  layer_ = dxf_name(group.layer);
  for (const Chain& chain : group.chains) {
    const bool grouped = !polylines_ && chain.curves.size() > 1;
    if (grouped) file_.begin_group();
    add(chain);
    if (grouped) file_.end_group();
  }
}

void DxfWriter::add_notes(std::vector<Diagnostic>& notes) const {
  const auto note = [&](std::size_t count, const char* message) {
    if (count > 0) notes.push_back({Diagnostic::Severity::Note, message, {}, count});
  };
  note(not_flat_, "DXF: a loop is not flat, written as a 3D polyline");
  note(chorded_, "DXF: a curve that a polyline cannot hold, written as chords");
}

std::vector<std::string> layer_names(const Result& result) {
  std::vector<std::string> names;
  std::unordered_set<std::string> known = {"0"};
  for (const std::string& layer : layers(result)) {
    std::string name = dxf_name(layer);
    if (known.insert(name).second) names.push_back(std::move(name));
  }
  return names;
}

}  // namespace

void write_dxf(const Result& result, const WriteOptions& options, Sink& sink,
               std::vector<Diagnostic>& notes) {
  const int unit = dxf_unit(result.model.metres_per_unit);
  if (unit == 0) note_unit("DXF", result.model.metres_per_unit, "unitless", notes);
  DxfWriter out(sink, options.dxf == DxfContent::Polyline);
  out.file().begin(bounding_box(result.model), unit, julian_date(options.timestamp), layer_names(result));
  for_each_group(result, options.edges, LoopShape::Fitted, [&](const Group& group) { out.add(group); });
  out.file().end();
  out.add_notes(notes);
}

}  // namespace meshcontour::detail

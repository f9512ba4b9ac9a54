// ISO 10303-21 exchange files: a geometrically bounded wireframe for AP242 or AP214.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text_writer.hpp"
#include "base/timestamp.hpp"
#include "meshcontour/version.hpp"
#include "write/drawing.hpp"
#include "write/sampling.hpp"
#include "write/step_text.hpp"
#include "write/units.hpp"
#include "write/writers.hpp"

namespace meshcontour::detail {
namespace {

using Id = std::uint64_t;

constexpr double kTurn = 2 * std::numbers::pi;

class StepWriter {
 public:
  explicit StepWriter(Sink& sink) : out_(sink) {}

  void begin(const Model& model, const WriteOptions& options);
  void add(const Group& group);
  void end(const Model& model);

 private:
  template <typename... Arguments>
  Id entity(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    out_.print("#{}=", ++last_);
    out_.print(format, std::forward<Arguments>(arguments)...);
    out_.text(";\n");
    return last_;
  }

  Id point(const Point& p);
  Id direction(const Vector& v);
  Id frame(const Point& origin, const Vector& axis, const Vector& reference);
  Id length_unit(double metres_per_unit);
  Id trimmed(Id basis, const Curve& curve, double first, double last);
  Id curve(const LineSegment& line, const std::string& name);
  Id curve(const CircularArc& arc, const std::string& name);
  Id curve(const EllipticalArc& arc, const std::string& name);
  Id curve(const BSplineCurve& spline, const std::string& name);
  Id polyline(const Chain& chain);
  Id composite(const Chain& chain);
  std::string point_list(const std::vector<Point>& points);
  void product(const Model& model, StepSchema schema);
  void context(const Model& model);

  TextWriter out_;
  Id last_ = 0;
  Id shape_ = 0, context_ = 0;
  std::vector<Id> sets_;
};

std::string id_list(const std::vector<Id>& ids) {
  std::string out;
  for (const Id id : ids) fmt::format_to(std::back_inserter(out), "{}#{}", out.empty() ? "" : ",", id);
  return out;
}

std::string real_list(const std::vector<double>& values) {
  std::string out;
  for (const double value : values)
    fmt::format_to(std::back_inserter(out), "{}{}", out.empty() ? "" : ",", StepReal{value});
  return out;
}

Id StepWriter::point(const Point& p) {
  out_.compiled(FMT_COMPILE("#{}=CARTESIAN_POINT('',{});\n"), ++last_, StepVector{p});
  return last_;
}

Id StepWriter::direction(const Vector& v) {
  out_.compiled(FMT_COMPILE("#{}=DIRECTION('',{});\n"), ++last_, StepVector{v});
  return last_;
}

Id StepWriter::frame(const Point& origin, const Vector& axis, const Vector& reference) {
  const Id at = point(origin), z = direction(axis), x = direction(reference);
  return entity("AXIS2_PLACEMENT_3D('',#{},#{},#{})", at, z, x);
}

Id StepWriter::trimmed(Id basis, const Curve& curve, double first, double last) {
  const Id start = point(start_of(curve)), end = point(end_of(curve));
  return entity("TRIMMED_CURVE('',#{},(#{},PARAMETER_VALUE({})),(#{},PARAMETER_VALUE({})),.T.,.PARAMETER.)",
                basis, start, StepReal{first}, end, StepReal{last});
}

Id StepWriter::curve(const LineSegment& line, const std::string& name) {
  const Vector along = line.end - line.start;
  const Id start = point(line.start), toward = direction(along.normalized());
  const Id vector = entity("VECTOR('',#{},1.)", toward);
  const Id basis = entity("LINE({},#{},#{})", step_string(name), start, vector);
  return trimmed(basis, line, 0, along.norm());
}

Id StepWriter::curve(const CircularArc& arc, const std::string& name) {
  const Id at = frame(arc.center, arc.axis, (arc.start - arc.center).normalized());
  const Id basis = entity("CIRCLE({},#{},{})", step_string(name), at, StepReal{arc.radius});
  return arc.full() ? basis : trimmed(basis, arc, 0, arc.angle);
}

Id StepWriter::curve(const EllipticalArc& arc, const std::string& name) {
  const double major = arc.major.norm();
  const Id at = frame(arc.center, arc.axis, arc.major / major);
  const Id basis =
      entity("ELLIPSE({},#{},{},{})", step_string(name), at, StepReal{major}, StepReal{arc.ratio * major});
  if (arc.full()) return basis;
  const double first = arc.start_parameter(), last = first + arc.angle;
  return trimmed(basis, arc, first, last > kTurn ? last - kTurn : last);
}

std::string StepWriter::point_list(const std::vector<Point>& points) {
  std::vector<Id> ids;
  ids.reserve(points.size());
  for (const Point& p : points) ids.push_back(point(p));
  return id_list(ids);
}

Id StepWriter::curve(const BSplineCurve& given, const std::string& name) {
  const BSplineCurve spline = to_clamped_bspline(given);
  const std::string points = point_list(spline.control_points);
  std::vector<double> knots;
  std::string multiplicities;
  for (auto knot = spline.knots.begin(); knot != spline.knots.end();) {
    const auto next = std::find_if(knot, spline.knots.end(), [&](double k) { return k != *knot; });
    fmt::format_to(std::back_inserter(multiplicities), "{}{}", knots.empty() ? "" : ",", next - knot);
    knots.push_back(*knot);
    knot = next;
  }
  const char* closed = spline.control_points.front() == spline.control_points.back() ? ".T." : ".F.";
  const std::string label = step_string(name), values = real_list(knots);
  if (spline.weights.empty()) {
    return entity("B_SPLINE_CURVE_WITH_KNOTS({},{},({}),.UNSPECIFIED.,{},.U.,({}),({}),.UNSPECIFIED.)", label,
                  spline.degree, points, closed, multiplicities, values);
  }
  return entity(
      "(BOUNDED_CURVE()B_SPLINE_CURVE({},({}),.UNSPECIFIED.,{},.U.)B_SPLINE_CURVE_WITH_KNOTS(({}),({}),"
      ".UNSPECIFIED.)CURVE()GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE(({}))"
      "REPRESENTATION_ITEM({}))",
      spline.degree, points, closed, multiplicities, values, real_list(spline.weights), label);
}

Id StepWriter::polyline(const Chain& chain) {
  std::vector<Point> points;
  for (const Point& p : chain.points) {
    if (points.empty() || p != points.back()) points.push_back(p);
  }
  if (chain.closed && points.front() != points.back()) points.push_back(points.front());
  if (points.size() < 2) return 0;
  return entity("POLYLINE({},({}))", step_string(chain.name), point_list(points));
}

Id StepWriter::composite(const Chain& chain) {
  std::vector<Id> curves;
  const bool alone = chain.curves.size() == 1;
  for (const Curve& piece : chain.curves) {
    const auto* line = std::get_if<LineSegment>(&piece);
    if (line != nullptr && line->start == line->end) continue;
    curves.push_back(
        std::visit([&](const auto& c) { return curve(c, alone ? chain.name : std::string()); }, piece));
  }
  if (curves.size() <= 1) return curves.empty() ? 0 : curves.front();
  for (Id& id : curves) {
    const bool ends = !chain.closed && &id == &curves.back();
    id = entity("COMPOSITE_CURVE_SEGMENT({},.T.,#{})", ends ? ".DISCONTINUOUS." : ".CONTINUOUS.", id);
  }
  return entity("COMPOSITE_CURVE({},({}),.F.)", step_string(chain.name), id_list(curves));
}

void StepWriter::add(const Group& group) {
  std::vector<Id> elements;
  for (const Chain& chain : group.chains) {
    const Id id = chain.points.empty() ? composite(chain) : polyline(chain);
    if (id != 0) elements.push_back(id);
  }
  if (elements.empty()) return;
  sets_.push_back(entity("GEOMETRIC_CURVE_SET({},({}))", step_string(group.name), id_list(elements)));
}

Id StepWriter::length_unit(double metres_per_unit) {
  const std::string_view prefix = si_prefix(metres_per_unit);
  if (!prefix.empty()) return entity("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT({},.METRE.))", prefix);
  const Id metre = entity("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.))");
  const Id factor =
      entity("LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE({}),#{})", StepReal{metres_per_unit}, metre);
  const Id exponents = entity("DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)");
  return entity("(CONVERSION_BASED_UNIT('{}',#{})LENGTH_UNIT()NAMED_UNIT(#{}))", unit_name(metres_per_unit),
                factor, exponents);
}

void StepWriter::product(const Model& model, StepSchema schema) {
  const bool ap242 = schema == StepSchema::Ap242;
  const std::string name = step_string(model.name.empty() ? "contours" : model.name);
  const Id application =
      entity("APPLICATION_CONTEXT('{}')", ap242 ? "managed model based 3d engineering"
                                                : "core data for automotive mechanical design processes");
  entity("APPLICATION_PROTOCOL_DEFINITION('international standard','{}',{},#{})",
         ap242 ? "ap242_managed_model_based_3d_engineering" : "automotive_design", ap242 ? 2014 : 2000,
         application);
  const Id product_context = entity("PRODUCT_CONTEXT('',#{},'mechanical')", application);
  const Id product = entity("PRODUCT({},{},'',(#{}))", name, name, product_context);
  entity("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(#{}))", product);
  const Id formation = entity("PRODUCT_DEFINITION_FORMATION('','',#{})", product);
  const Id definition_context =
      entity("PRODUCT_DEFINITION_CONTEXT('part definition',#{},'design')", application);
  const Id definition = entity("PRODUCT_DEFINITION('design','',#{},#{})", formation, definition_context);
  shape_ = entity("PRODUCT_DEFINITION_SHAPE('','',#{})", definition);
}

// What a reader may take for the same point: a power of ten near 1e-7 of the model's size.
double uncertainty(const Model& model) {
  const Box box = bounding_box(model);
  const double size = box.isEmpty() ? 0 : box.diagonal().norm();
  return size > 0 ? std::pow(10, std::floor(std::log10(size)) - 7) : 1e-6;
}

void StepWriter::context(const Model& model) {
  const Id length = length_unit(model.metres_per_unit > 0 ? model.metres_per_unit : 0.001);
  const Id angle = entity("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
  const Id solid_angle = entity("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
  const Id accuracy = entity(
      "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({}),#{},'distance_accuracy_value','confusion accuracy')",
      StepReal{uncertainty(model)}, length);
  context_ = entity(
      "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#{}))"
      "GLOBAL_UNIT_ASSIGNED_CONTEXT((#{},#{},#{}))REPRESENTATION_CONTEXT('','3D'))",
      accuracy, length, angle, solid_angle);
}

void StepWriter::begin(const Model& model, const WriteOptions& options) {
  const bool ap242 = options.step == StepSchema::Ap242;
  const std::string name = step_string(model.name.empty() ? "contours" : model.name);
  out_.print(
      "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('contour curves'),'2;1');\n"
      "FILE_NAME({},'{}',(''),(''),'meshcontour "
      "{}','meshcontour','');\nFILE_SCHEMA(('{}'));\nENDSEC;\nDATA;\n",
      name, iso_time(options.timestamp), version(),
      ap242 ? "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }"
            : "AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }");
  product(model, options.step);
  context(model);
}

void StepWriter::end(const Model& model) {
  const Id origin = frame(Point::Zero(), Vector::UnitZ(), Vector::UnitX());
  sets_.insert(sets_.begin(), origin);
  const std::string_view type =
      sets_.size() > 1 ? "GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION" : "SHAPE_REPRESENTATION";
  const Id representation =
      entity("{}({},({}),#{})", type, step_string(model.name.empty() ? "contours" : model.name),
             id_list(sets_), context_);
  entity("SHAPE_DEFINITION_REPRESENTATION(#{},#{})", shape_, representation);
  out_.text("ENDSEC;\nEND-ISO-10303-21;\n");
  out_.flush();
}

}  // namespace

void write_step(const Result& result, const WriteOptions& options, Sink& sink,
                std::vector<Diagnostic>& notes) {
  if (!(result.model.metres_per_unit > 0)) note_unit("STEP", 0, "millimetre", notes);
  StepWriter out(sink);
  out.begin(result.model, options);
  for_each_group(result, options.edges, LoopShape::Fitted, [&](const Group& group) { out.add(group); });
  out.end(result.model);
}

}  // namespace meshcontour::detail

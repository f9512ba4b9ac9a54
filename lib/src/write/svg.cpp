#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/escape.hpp"
#include "base/text_writer.hpp"
#include "model/blossom.hpp"
#include "model/conic.hpp"
#include "write/drawing.hpp"
#include "write/sampling.hpp"
#include "write/writers.hpp"

namespace meshcontour::detail {
namespace {

using Point2 = Eigen::Vector2d;
using Box2 = Eigen::AlignedBox2d;

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kEdgeOn =
    1e-6;  // axis ratio of an ellipse that is seen as a line; readers lose digits by less
constexpr double kMargin = 0.03;        // of the picture's diagonal, on each side
constexpr double kStrokeWidth = 0.002;  // of the picture's diagonal
constexpr double kPrecision = 1e-10;    // of the picture's diagonal
constexpr int kPiecesOfSpan = 16;       // cubics for a span that is no cubic itself

// The model seen from a side; y runs down.
class Projection {
 public:
  Projection(View view, UpAxis up) {
    const Eigen::Matrix3d axes = view_axes(view == View::Report ? View::Iso : view, up);
    matrix_.row(0) = axes.row(0);
    matrix_.row(1) = -axes.row(1);
  }

  Point2 operator()(const Vector& v) const { return matrix_ * v; }

 private:
  Eigen::Matrix<double, 2, 3> matrix_;
};

// An ellipse in the picture: center + cos(t) first + sin(t) second, t from begin over angle.
struct Ellipse {
  Ellipse(const ConicFrame& frame, const Projection& project)
      : center(project(frame.center)),
        first(project(frame.first)),
        second(project(frame.second)),
        begin(frame.begin),
        angle(frame.angle),
        end(project(frame.end)) {}

  Point2 at(double t) const { return center + std::cos(t) * first + std::sin(t) * second; }

  Point2 center, first, second;
  double begin, angle;
  Point2 end;
};

void extend(Box2& box, const Ellipse& ellipse) {
  box.extend(ellipse.at(ellipse.begin));
  box.extend(ellipse.end);
  for (const int axis : {0, 1}) {
    const double extreme = std::atan2(ellipse.second[axis], ellipse.first[axis]);
    for (const double t : {extreme, extreme + kTurn / 2}) {
      const double ahead = t - ellipse.begin, turns = std::floor(ahead / kTurn);
      if (ahead - turns * kTurn <= ellipse.angle) box.extend(ellipse.at(t));
    }
  }
}

void extend(Box2& box, const Curve& curve, const Projection& project) {
  if (const auto* line = std::get_if<LineSegment>(&curve)) {
    box.extend(project(line->start));
    box.extend(project(line->end));
  } else if (const auto* spline = std::get_if<BSplineCurve>(&curve)) {
    for (const Point& p : spline->control_points) box.extend(project(p));
  } else {
    const auto* arc = std::get_if<CircularArc>(&curve);
    extend(box, Ellipse(arc != nullptr ? conic_frame(*arc) : conic_frame(std::get<EllipticalArc>(curve)),
                        project));
  }
}

Box2 bounds(const Result& result, EdgeUse edges, const Projection& project) {
  Box2 box;
  for_each_group(result, edges, LoopShape::Fitted, [&](const Group& group) {
    for (const Chain& chain : group.chains) {
      for (const Point& p : chain.points) box.extend(project(p));
      for (const Curve& curve : chain.curves) extend(box, curve, project);
    }
  });
  return box;
}

class SvgWriter {
 public:
  SvgWriter(Sink& sink, const Projection& project) : out_(sink), project_(project) {}

  void begin(const Model& model, const Box2& box);
  void add(const Group& group);
  void end();

 private:
  void number(double value);
  void to(char command, const Point2& p);
  void path(const Chain& chain);
  void draw(const LineSegment& line) { to('L', project_(line.end)); }
  template <typename Arc>
  void draw(const Arc& arc);
  void draw(const BSplineCurve& spline);
  void bezier_pieces(const BSplineCurve& spline);
  void hermite_pieces(const BSplineCurve& spline);

  TextWriter out_;
  const Projection& project_;
  int decimals_ = 6;
};

// With as many decimals as the size of the picture asks for, without the zeros at their end.
void SvgWriter::number(double value) {
  fmt::memory_buffer buffer;
  fmt::format_to(std::back_inserter(buffer), FMT_COMPILE("{:.{}f}"), value, decimals_);
  std::string_view text(buffer.data(), buffer.size());
  if (decimals_ > 0) text = text.substr(0, text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.remove_suffix(1);
  out_.text(text == "-0" ? "0" : text);
}

void SvgWriter::to(char command, const Point2& p) {
  if (command != ' ') out_.text({&command, 1});
  number(p.x());
  out_.text(" ");
  number(p.y());
}

// A third of a turn at most at once: an arc command cannot tell a full turn from none, and the centre of half
// a turn depends on the last digits of its ends.
template <typename Arc>
void SvgWriter::draw(const Arc& arc) {
  const Ellipse ellipse(conic_frame(arc), project_);
  const Point2 &first = ellipse.first, &second = ellipse.second;
  const double turn = std::atan2(2 * first.dot(second), first.squaredNorm() - second.squaredNorm()) / 2;
  const Point2 major = std::cos(turn) * first + std::sin(turn) * second;
  const double long_axis = major.norm(),
               short_axis = (std::cos(turn) * second - std::sin(turn) * first).norm();
  if (short_axis <= kEdgeOn * long_axis) {
    const std::vector<Point> points = sampled(arc, kPrecision * 1e6 * long_axis);
    for (std::size_t i = 1; i < points.size(); ++i) to('L', project_(points[i]));
    return;
  }
  const bool clockwise = first.x() * second.y() - first.y() * second.x() > 0;
  const int pieces = std::max(1, static_cast<int>(std::ceil(ellipse.angle / (kTurn / 3) - 1e-9)));
  for (int piece = 1; piece <= pieces; ++piece) {
    out_.text("A");
    number(long_axis);
    out_.text(" ");
    number(short_axis);
    out_.print(" {} 0 {} ", std::atan2(major.y(), major.x()) * 360 / kTurn, clockwise ? 1 : 0);
    to(' ', piece == pieces ? ellipse.end : ellipse.at(ellipse.begin + ellipse.angle * piece / pieces));
  }
}

// Each span of a polynomial curve up to the third degree is what SVG has commands for.
void SvgWriter::bezier_pieces(const BSplineCurve& spline) {
  constexpr std::string_view commands = " LQC";
  const auto degree = static_cast<std::size_t>(spline.degree);
  for (std::size_t span = degree; span < spline.control_points.size(); ++span) {
    const double low = spline.knots[span], high = spline.knots[span + 1];
    if (low == high) continue;
    for (int i = 1; i <= spline.degree; ++i) {
      const auto argument = [&](int r) { return r <= spline.degree - i ? low : high; };
      if (i > 1) out_.text(" ");
      to(i == 1 ? commands[degree] : ' ', project_(projected(spline, blossom(spline, span, argument))));
    }
  }
}

// Cubics with the curve's points and tangents at their ends.
void SvgWriter::hermite_pieces(const BSplineCurve& spline) {
  const auto degree = static_cast<std::size_t>(spline.degree);
  for (std::size_t span = degree; span < spline.control_points.size(); ++span) {
    const double low = spline.knots[span], high = spline.knots[span + 1];
    if (low == high) continue;
    const double step = (high - low) / kPiecesOfSpan;
    for (int i = 0; i < kPiecesOfSpan; ++i) {
      // Just inside the span: at a multiple knot the tangent may jump.
      const double begin = std::max(low + i * step, std::nextafter(low, high));
      const double end = i + 1 == kPiecesOfSpan ? std::nextafter(high, low) : low + (i + 1) * step;
      const auto from = derivatives(spline, begin, 1), to_end = derivatives(spline, end, 1);
      to('C', project_((from.row(0) + from.row(1) * step / 3).transpose()));
      out_.text(" ");
      to(' ', project_((to_end.row(0) - to_end.row(1) * step / 3).transpose()));
      out_.text(" ");
      to(' ', project_(to_end.row(0).transpose()));
    }
  }
}

void SvgWriter::draw(const BSplineCurve& given) {
  const BSplineCurve spline = to_clamped_bspline(given);
  spline.weights.empty() && spline.degree <= 3 ? bezier_pieces(spline) : hermite_pieces(spline);
}

void SvgWriter::path(const Chain& chain) {
  out_.print("<path id=\"{}\" d=\"", xml_escaped(one_word(chain.name)));
  char command = 'M';
  for (const Point& p : chain.points) to(std::exchange(command, 'L'), project_(p));
  if (!chain.curves.empty()) to('M', project_(start_of(chain.curves.front())));
  for (const Curve& curve : chain.curves) {
    std::visit([&](const auto& c) { draw(c); }, curve);
  }
  out_.text(chain.closed ? "Z\"/>\n" : "\"/>\n");
}

void SvgWriter::add(const Group& group) {
  out_.print("<g id=\"{}\">\n", xml_escaped(one_word(group.name)));
  for (const Chain& chain : group.chains) path(chain);
  out_.text("</g>\n");
}

void SvgWriter::begin(const Model& model, const Box2& box) {
  const double diagonal = box.isEmpty() ? 1 : std::max(box.diagonal().norm(), 1e-300);
  decimals_ = std::clamp(-static_cast<int>(std::floor(std::log10(kPrecision * diagonal))), 0, 320);
  const Point2 margin = Point2::Constant(kMargin * diagonal);
  const Point2 low = box.isEmpty() ? Point2(0, 0) : Point2(box.min() - margin);
  const Point2 size = box.isEmpty() ? Point2(1, 1) : Point2(box.sizes() + 2 * margin);
  const bool known = model.metres_per_unit > 0;
  const double millimetres = known ? 1000 * model.metres_per_unit : 1;
  out_.print(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" "
      "width=\"{0}{2}\" height=\"{1}{2}\" viewBox=\"",
      size.x() * millimetres, size.y() * millimetres, known ? "mm" : "");
  to(' ', low);
  out_.text(" ");
  to(' ', size);
  out_.print(
      "\">\n<title>{}</title>\n<g fill=\"none\" stroke=\"#000000\" stroke-linejoin=\"round\" stroke-width=\"",
      xml_escaped(model.name));
  number(kStrokeWidth * diagonal);
  out_.text("\">\n");
}

void SvgWriter::end() {
  out_.text("</g>\n</svg>\n");
  out_.flush();
}

}  // namespace

void write_svg(const Result& result, const WriteOptions& options, Sink& sink, std::vector<Diagnostic>&) {
  const Projection project(options.view, options.up);
  SvgWriter out(sink, project);
  out.begin(result.model, bounds(result, options.edges, project));
  for_each_group(result, options.edges, LoopShape::Fitted, [&](const Group& group) { out.add(group); });
  out.end();
}

}  // namespace meshcontour::detail

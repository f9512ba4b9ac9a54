// B-splines of any knots and weights: what gluNurbsCurve makes of them lies on our own curve.

#include <cmath>

#include "fuzz/targets.hpp"
#include "meshcontour/curve.hpp"
#include "render/bezier.hpp"
#include "render/camera.hpp"
#include "render/gl_nurbs.hpp"

namespace fuzz {
namespace {

using namespace meshcontour;

// Clamped, of degree 1 to 5, with up to 60 control points, inner knots single or repeated; rational or not.
BSplineCurve curve_of(Source& source) {
  const std::uint8_t choice = source.byte();
  BSplineCurve curve;
  curve.degree = 1 + choice % 5;
  const auto order = static_cast<std::size_t>(curve.degree) + 1;
  const std::size_t inner = source.byte() % 55u;
  const double scale = std::ldexp(1.0, source.byte() % 32 - 16);
  curve.knots.assign(order, 0);
  std::size_t repeated = 0;
  for (std::size_t i = 0; i < inner; ++i) {
    const std::uint8_t step = source.byte();
    repeated = step == 0 && i > 0 ? repeated + 1 : 1;
    const bool again = step == 0 && i > 0 && repeated < order;
    curve.knots.push_back(again ? curve.knots.back() : curve.knots.back() + 1 + step);
    if (!again) repeated = 1;
  }
  curve.knots.insert(curve.knots.end(), order, curve.knots.back() + 1);
  for (std::size_t i = 0; i < inner + order; ++i) {
    Point p;
    for (int k = 0; k < 3; ++k) p[k] = scale * static_cast<std::int16_t>(source.word());
    curve.control_points.push_back(p);
    if (choice & 128) curve.weights.push_back(std::ldexp(1.0, source.byte() % 7 - 3));
  }
  return curve;
}

}  // namespace

void evaluate_nurbs(Bytes input) {
  Source source(input);
  const BSplineCurve curve = curve_of(source);
  Box box;
  for (const Point& p : curve.control_points) box.extend(p);
  const detail::LocalFrame frame{box.center(), std::max(box.diagonal().norm() / 2, 1e-30)};
  const detail::BezierCurve bezier = detail::to_bezier(curve, frame.center, frame.size);
  const auto knots = detail::bezier_knots(bezier.pieces(), bezier.degree);
  const auto control = detail::packed_control(bezier, 0, bezier.pieces());
  detail::NurbsTessellator tessellator;
  tessellator.tessellate({bezier.degree + 1, bezier.rational, knots, control, 4.5F});
  std::vector<double> breaks = curve.knots;
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  require(tessellator.starts().size() == breaks.size() - 1, "another number of spans than of knots");
  for (std::size_t span = 0; span + 1 < breaks.size(); ++span) {
    const std::size_t begin = tessellator.starts()[span];
    const std::size_t end =
        span + 2 < breaks.size() ? tessellator.starts()[span + 1] : tessellator.points().size();
    for (std::size_t i = begin; i < end; ++i) {
      const double t = static_cast<double>(i - begin) / static_cast<double>(end - begin - 1);
      const double u = std::lerp(breaks[span], breaks[span + 1], t);
      const auto& v = tessellator.points()[i];
      const Point drawn = frame.center + frame.size * Point(v[0], v[1], v[2]);
      const Point own = evaluate(curve, u);
      require((drawn - own).norm() <= 1e-4 * frame.size + 1e-12 * own.norm(), "GLU draws another curve");
    }
  }
}

}  // namespace fuzz

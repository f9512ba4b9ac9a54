#include "base/escape.hpp"
#include "base/text_writer.hpp"
#include "meshcontour/mesh_write.hpp"
#include "write/drawing.hpp"
#include "write/sampling.hpp"
#include "write/writers.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kChordTolerance = 1e-4;  // of the curve's size, as for fits

class ObjWriter {
 public:
  explicit ObjWriter(Sink& sink) : out_(sink) {}

  void write_polyline(const Chain& chain);
  void write_curves(const Chain& chain);
  void finish() { out_.flush(); }

 private:
  void write_point(const Point& p) { out_.compiled(FMT_COMPILE("v {} {} {}\n"), p.x(), p.y(), p.z()); }
  void write_bspline(const BSplineCurve& curve);

  TextWriter out_;
  std::uint64_t vertices_ = 0;  // written so far; indices are from 1 over the whole file
};

void ObjWriter::write_polyline(const Chain& chain) {
  const std::vector<Point> points = chain_points(chain, kChordTolerance * chain_size(chain));
  out_.print("o {}\n", one_word(chain.name));
  for (const Point& p : points) write_point(p);
  out_.text("l");
  for (std::size_t i = 1; i <= points.size(); ++i) out_.compiled(FMT_COMPILE(" {}"), vertices_ + i);
  if (chain.closed) out_.print(" {}", vertices_ + 1);
  out_.text("\n");
  vertices_ += points.size();
}

// [Wavefront, Object Files (.obj), appendix B1: free-form curve attributes]
void ObjWriter::write_bspline(const BSplineCurve& curve) {
  const bool rational = !curve.weights.empty();
  for (std::size_t i = 0; i < curve.control_points.size(); ++i) {
    const Point& p = curve.control_points[i];
    if (rational) {
      out_.compiled(FMT_COMPILE("v {} {} {} {}\n"), p.x(), p.y(), p.z(), curve.weights[i]);
    } else {
      write_point(p);
    }
  }
  const auto [begin, end] = curve.domain();
  out_.print("cstype {}bspline\ndeg {}\ncurv {} {}", rational ? "rat " : "", curve.degree, begin, end);
  for (std::size_t i = 1; i <= curve.control_points.size(); ++i)
    out_.compiled(FMT_COMPILE(" {}"), vertices_ + i);
  out_.text("\nparm u");
  for (const double knot : curve.knots) out_.compiled(FMT_COMPILE(" {}"), knot);
  out_.text("\nend\n");
  vertices_ += curve.control_points.size();
}

void ObjWriter::write_curves(const Chain& chain) {
  const std::string name = one_word(chain.name);
  out_.print("o {}\n", name);
  for (std::size_t i = 0; i < chain.curves.size(); ++i) {
    out_.print("g {}_segment_{}_{}\n", name, i + 1, type_name(chain.curves[i]));
    write_bspline(to_clamped_bspline(chain.curves[i]));
  }
  if (chain.points.empty()) return;
  BSplineCurve polygon{1, {0}, chain.points, {}, false};
  if (chain.closed) polygon.control_points.push_back(chain.points.front());
  for (std::size_t i = 0; i < polygon.control_points.size(); ++i)
    polygon.knots.push_back(static_cast<double>(i));
  polygon.knots.push_back(polygon.knots.back());
  out_.print("g {}_polygon\n", name);
  write_bspline(polygon);
}

}  // namespace

void write_obj(const Result& result, const WriteOptions& options, Sink& sink, std::vector<Diagnostic>&) {
  if (options.obj == ObjContent::Tree) return write_lines(LineFormat::Obj, result.model.tree, sink);
  if (options.obj == ObjContent::Path) return write_lines(LineFormat::Obj, result.model.path, sink);
  const bool curves = options.obj == ObjContent::Curves;
  ObjWriter out(sink);
  for_each_group(result, options.edges, curves ? LoopShape::Fitted : LoopShape::Polygon,
                 [&](const Group& group) {
                   for (const Chain& chain : group.chains)
                     curves ? out.write_curves(chain) : out.write_polyline(chain);
                 });
  out.finish();
}

}  // namespace meshcontour::detail

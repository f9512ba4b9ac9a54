#include "base/escape.hpp"
#include "base/text_writer.hpp"
#include "write/sampling.hpp"
#include "write/writers.hpp"

namespace meshcontour::detail {
namespace {

void write_loops(const Result& result, TextWriter& out) {
  out.text("shell,patch,loop,closed,index,vertex,x,y,z\n");
  for (std::size_t s = 0; s < result.boundaries.size(); ++s) {
    const Shell& shell = result.model.shells[s];
    const std::string id = csv_field(shell.id);
    const auto& patches = result.boundaries[s].patches;
    for (std::size_t p = 0; p < patches.size(); ++p) {
      for (std::size_t l = 0; l < patches[p].loops.size(); ++l) {
        const BoundaryLoop& loop = patches[p].loops[l];
        const std::string head = fmt::format("{},{},{},{}", id, p + 1, l + 1, loop.closed ? 1 : 0);
        for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
          const Point& point = shell.points[loop.vertices[i]];
          out.compiled(FMT_COMPILE("{},{},{},{},{},{}\n"), head, i, loop.vertices[i], point.x(), point.y(),
                       point.z());
        }
      }
    }
  }
}

void write_segment(const Segment& segment, TextWriter& out) {
  const Curve& curve = segment.curve;
  const Point start = start_of(curve), end = end_of(curve);
  const auto* spline = std::get_if<BSplineCurve>(&curve);
  const auto* arc = std::get_if<CircularArc>(&curve);
  if (spline != nullptr) {
    out.print("{},{},{},", type_name(curve), spline->degree, spline->control_points.size());
  } else {
    out.print("{},,,", type_name(curve));
  }
  out.compiled(FMT_COMPILE("{},{},{},{},{},{},"), start.x(), start.y(), start.z(), end.x(), end.y(), end.z());
  if (arc != nullptr) out.print("{}", arc->radius);
  out.print(",{}\n", segment.deviation);
}

void write_curves(const Result& result, TextWriter& out) {
  out.text(
      "shell,patch,loop,segment,type,degree,control_points,start_x,start_y,start_z,end_x,end_y,end_z,"
      "radius,deviation\n");
  for (const Contour& contour : result.contours) {
    const std::string id = csv_field(result.model.shells[contour.shell].id);
    for (std::size_t i = 0; i < contour.segments.size(); ++i) {
      out.print("{},{},{},{},", id, contour.patch + 1, contour.loop + 1, i + 1);
      write_segment(contour.segments[i], out);
    }
  }
}

}  // namespace

void write_csv(const Result& result, const WriteOptions& options, Sink& sink, std::vector<Diagnostic>&) {
  TextWriter out(sink);
  if (options.csv == CsvContent::Loops) {
    write_loops(result, out);
  } else {
    write_curves(result, out);
  }
  out.flush();
}

}  // namespace meshcontour::detail

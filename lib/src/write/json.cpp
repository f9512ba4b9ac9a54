#include <limits>

#include "base/escape.hpp"
#include "base/text_writer.hpp"
#include "write/drawing.hpp"
#include "write/sampling.hpp"
#include "write/writers.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();  // prints as null

// Commas between the elements of one list.
class Separator {
 public:
  std::string_view operator()() { return std::exchange(first_, false) ? "" : ","; }

 private:
  bool first_ = true;
};

void write_vector(const Vector& v, TextWriter& out) {
  out.compiled(FMT_COMPILE("[{},{},{}]"), JsonNumber{v.x()}, JsonNumber{v.y()}, JsonNumber{v.z()});
}

void write_numbers(std::span<const double> numbers, TextWriter& out) {
  Separator separator;
  out.text("[");
  for (const double number : numbers) out.compiled(FMT_COMPILE("{}{}"), separator(), JsonNumber{number});
  out.text("]");
}

void write_named_vector(std::string_view name, const Vector& v, TextWriter& out) {
  out.print(",\"{}\":", name);
  write_vector(v, out);
}

void write_shape(const LineSegment&, TextWriter&) {}

void write_shape(const CircularArc& arc, TextWriter& out) {
  write_named_vector("center", arc.center, out);
  write_named_vector("axis", arc.axis, out);
  out.print(",\"radius\":{},\"angle\":{}", JsonNumber{arc.radius}, JsonNumber{arc.angle});
}

void write_shape(const EllipticalArc& arc, TextWriter& out) {
  write_named_vector("center", arc.center, out);
  write_named_vector("axis", arc.axis, out);
  write_named_vector("major", arc.major, out);
  out.print(",\"ratio\":{},\"angle\":{}", JsonNumber{arc.ratio}, JsonNumber{arc.angle});
}

void write_shape(const BSplineCurve& curve, TextWriter& out) {
  out.print(",\"degree\":{},\"knots\":", curve.degree);
  write_numbers(curve.knots, out);
  out.text(",\"control_points\":[");
  Separator separator;
  for (const Point& p : curve.control_points) {
    out.text(separator());
    write_vector(p, out);
  }
  out.text("]");
  if (!curve.weights.empty()) {
    out.text(",\"weights\":");
    write_numbers(curve.weights, out);
  }
  out.print(",\"periodic\":{}", curve.periodic);
}

void write_ends(const Curve& curve, TextWriter& out) {
  write_named_vector("start", start_of(curve), out);
  write_named_vector("end", end_of(curve), out);
  std::visit([&](const auto& shape) { write_shape(shape, out); }, curve);
}

void write_segments(const Contour* contour, TextWriter& out) {
  Separator separator;
  out.text("[");
  for (std::size_t i = 0; contour != nullptr && i < contour->segments.size(); ++i) {
    const Segment& segment = contour->segments[i];
    out.print("{}{{\"type\":\"{}\",\"from\":{},\"to\":{}", separator(), type_name(segment.curve),
              segment.from, segment.to);
    write_ends(segment.curve, out);
    out.print(",\"deviation\":{}}}", JsonNumber{segment.deviation});
  }
  out.text("]");
}

double polygon_length(const Shell& shell, const BoundaryLoop& loop) {
  const std::size_t count = loop.vertices.size(),
                    chords = loop.closed ? count : count - std::min<std::size_t>(count, 1);
  double sum = 0;
  for (std::size_t i = 0; i < chords; ++i) {
    sum += (shell.points[loop.vertices[(i + 1) % count]] - shell.points[loop.vertices[i]]).norm();
  }
  return sum;
}

void write_model(const Result& result, TextWriter& out) {
  const Counts counts = counts_of(result.model, result.boundaries, result.contours);
  out.print(
      "{{\n\"model\":{{\"name\":{},\"shells\":{},\"instances\":{},\"patches\":{},\"vertices\":{},"
      "\"triangles\":{},"
      "\"metres_per_unit\":{}}},\n",
      json_quoted(result.model.name), counts.shells, counts.instances, counts.patches, counts.vertices,
      counts.triangles,
      JsonNumber{result.model.metres_per_unit > 0 ? result.model.metres_per_unit : kUnknown});
  out.print("\"boundary\":{{\"edges\":{},\"vertices\":{},\"loops\":{},\"extractor\":{}}},\n",
            counts.boundary_edges, counts.boundary_vertices, counts.loops, json_quoted(result.extractor));
}

void write_instances(const Model& model, TextWriter& out) {
  Separator separator;
  out.text("\"instances\":[");
  for (const Instance& instance : model.instances) {
    out.print("{}\n{{\"shell\":{},\"path\":{},\"placement\":", separator(),
              json_quoted(model.shells[instance.shell].id), json_quoted(instance.path));
    write_numbers({instance.placement.data(), 16}, out);  // column major, as Eigen holds it
    out.text("}");
  }
  out.text("],\n");
}

void write_loops(const Result& result, std::size_t s, std::size_t p, TextWriter& out) {
  const auto& loops = result.boundaries[s].patches[p].loops;
  Separator separator;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const Contour* contour = find_contour(result.contours, s, p, l);
    out.print("{}\n {{\"loop\":{},\"vertices\":{},\"closed\":{},\"length\":{},\"segments\":", separator(),
              l + 1, loops[l].vertices.size(), loops[l].closed,
              JsonNumber{polygon_length(result.model.shells[s], loops[l])});
    write_segments(contour, out);
    out.print(",\"deviation\":{}{}}}", JsonNumber{contour != nullptr ? contour->deviation : kUnknown},
              contour != nullptr && contour->fallback ? ",\"fallback\":true" : "");
  }
}

void write_patches(const Result& result, TextWriter& out) {
  Separator separator;
  out.text("\"patches\":[");
  for (std::size_t s = 0; s < result.model.shells.size(); ++s) {
    const Shell& shell = result.model.shells[s];
    for (std::size_t p = 0; p < shell.patches.size(); ++p) {
      out.print("{}\n{{\"shell\":{},\"patch\":{},\"triangles\":{},\"loops\":[", separator(),
                json_quoted(shell.id), p + 1, shell.patches[p].triangle_count);
      if (!result.boundaries.empty()) write_loops(result, s, p, out);
      out.text("]}");
    }
  }
  out.text("],\n");
}

// Only where a model has some: most files know neither.
void write_drawings(const Model& model, TextWriter& out) {
  Separator lines, curves;
  for (const Polyline& line : model.annotations) {
    const bool first = &line == &model.annotations.front();
    out.print("{}{}\n{{\"name\":{},\"points\":[", first ? "\"annotations\":[" : "", lines(),
              json_quoted(line.name));
    Separator points;
    for (const Point& p : line.points) {
      out.text(points());
      write_vector(p, out);
    }
    out.text(&line == &model.annotations.back() ? "]}],\n" : "]}");
  }
  for (const NamedCurve& curve : model.curves) {
    const bool first = &curve == &model.curves.front();
    out.print("{}{}\n{{\"name\":{},\"type\":\"{}\"", first ? "\"curves\":[" : "", curves(),
              json_quoted(curve.name), type_name(curve.curve));
    write_ends(curve.curve, out);
    out.text(&curve == &model.curves.back() ? "}],\n" : "}");
  }
}

void write_diagnostics(std::span<const Diagnostic> diagnostics, TextWriter& out) {
  Separator separator;
  out.text("\"diagnostics\":[");
  for (const Diagnostic& diagnostic : diagnostics) {
    const bool warning = diagnostic.severity == Diagnostic::Severity::Warning;
    out.print(
        "{}\n{{\"severity\":\"{}\",\"message\":{},\"file\":{},\"line\":{},\"element\":{},\"count\":{}}}",
        separator(), warning ? "warning" : "note", json_quoted(diagnostic.message),
        json_quoted(diagnostic.spot.file), diagnostic.spot.line, json_quoted(diagnostic.spot.element),
        diagnostic.count);
  }
  out.text("],\n");
}

void write_timings(std::span<const StageTime> timings, TextWriter& out) {
  Separator separator;
  out.text("\"timings\":[");
  for (const StageTime& time : timings) {
    out.print("{}\n{{\"stage\":{},\"wall_ms\":{:.3f},\"cpu_ms\":{:.3f},\"items\":{}}}", separator(),
              json_quoted(time.stage), time.wall_ms, time.cpu_ms, time.items);
  }
  out.text("]\n}\n");
}

}  // namespace

void write_json(const Result& result, const WriteOptions&, Sink& sink, std::vector<Diagnostic>&) {
  TextWriter out(sink);
  write_model(result, out);
  write_instances(result.model, out);
  write_patches(result, out);
  write_drawings(result.model, out);
  write_diagnostics(result.diagnostics, out);
  write_timings(result.timings, out);
  out.flush();
}

}  // namespace meshcontour::detail

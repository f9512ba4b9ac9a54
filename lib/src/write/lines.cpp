#include "base/text_writer.hpp"
#include "meshcontour/mesh_write.hpp"
#include "write/writers.hpp"

namespace meshcontour {
namespace {

using detail::TextWriter;

void write_obj(std::span<const Polyline> lines, TextWriter& out) {
  std::size_t first = 1;
  const std::string* name = nullptr;
  for (const Polyline& line : lines) {
    if (name == nullptr || *name != line.name) out.print("o {}\n", printable(line.name));
    name = &line.name;
    for (const Point& p : line.points) out.print("v {} {} {}\n", p.x(), p.y(), p.z());
    out.text("l");
    for (std::size_t i = 0; i < line.points.size(); ++i) out.print(" {}", first + i);
    out.text("\n");
    first += line.points.size();
  }
}

void write_line_set(std::span<const Polyline> lines, TextWriter& out) {
  out.text(
      "#VRML V2.0 utf8\nShape {\n  appearance Appearance { material Material { emissiveColor 1 0 0 } }\n"
      "  geometry IndexedLineSet {\n    coord Coordinate {\n      point [\n");
  for (const Polyline& line : lines) {
    for (const Point& p : line.points) out.print("{} {} {},\n", p.x(), p.y(), p.z());
  }
  out.text("      ]\n    }\n    coordIndex [\n");
  std::size_t next = 0;
  for (const Polyline& line : lines) {
    for (std::size_t i = 0; i < line.points.size(); ++i) out.print("{}, ", next++);
    out.text("-1,\n");
  }
  out.text("    ]\n  }\n}\n");
}

}  // namespace

void write_lines(LineFormat format, std::span<const Polyline> lines, Sink& sink) {
  TextWriter out(sink);
  switch (format) {
    case LineFormat::Obj:
      write_obj(lines, out);
      break;
    case LineFormat::Wrl:
      write_line_set(lines, out);
      break;
  }
  out.flush();
}

void detail::write_wrl(const Result& result, const WriteOptions& options, Sink& sink,
                       std::vector<Diagnostic>&) {
  const bool path = options.wrl == WrlContent::Path;
  write_lines(LineFormat::Wrl, path ? result.model.path : result.model.tree, sink);
}

}  // namespace meshcontour

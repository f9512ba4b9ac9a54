#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/text_writer.hpp"
#include "write/byte_buffer.hpp"
#include "write/mesh_pieces.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::size_t kHeaderBytes = 80;

using Corners = std::array<Point, 3>;

Corners corners_of(const MeshPiece& piece, std::size_t triangle) {
  const Triangle t = piece.triangle(triangle);
  return {piece.point(t[0]), piece.point(t[1]), piece.point(t[2])};
}

// Of length 1, or zero for a triangle without area.
Vector normal_of(const Corners& corners) {
  const Vector normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double length = normal.stableNorm();
  return length > 0 && std::isfinite(length) ? Vector(normal / length) : Vector(Vector::Zero());
}

Eigen::Vector3f single(const Point& point) {
  const Eigen::Vector3f rounded = point.cast<float>();
  if (!rounded.allFinite()) throw Error(ErrorCode::BadData, "a coordinate is too large for binary STL");
  return rounded;
}

void write_binary(const MeshPieces& mesh, Sink& sink, std::vector<Diagnostic>& notes) {
  check_count(mesh.triangles, std::numeric_limits<std::uint32_t>::max(), "triangles");
  ByteBuffer out(sink);
  std::string header = "meshcontour";
  header.resize(kHeaderBytes, ' ');
  out.put_text(header);
  out.put(static_cast<std::uint32_t>(mesh.triangles));
  std::size_t collapsed = 0;
  for (const MeshPiece& piece : mesh.pieces) {
    for (std::size_t t = 0; t < piece.shell.triangles.size(); ++t) {
      const Corners corners = corners_of(piece, t);
      const Eigen::Vector3f a = single(corners[0]), b = single(corners[1]), c = single(corners[2]);
      const Eigen::Vector3f normal = normal_of(corners).cast<float>();
      for (const Eigen::Vector3f& v : {normal, a, b, c}) {
        for (const float value : v) out.put(value);
      }
      out.put(std::uint16_t{0});
      out.flush_if_full();
      collapsed += a == b || b == c || c == a ? 1 : 0;
    }
  }
  out.flush();
  if (collapsed == 0) return;
  notes.push_back(
      {Diagnostic::Severity::Warning, "triangle with two corners equal in single precision", {}, collapsed});
}

void write_facet(const Corners& corners, TextWriter& out) {
  const Eigen::Vector3f normal = normal_of(corners).cast<float>();
  out.print("facet normal {} {} {}\n outer loop\n", normal.x(), normal.y(), normal.z());
  for (const Point& p : corners) out.print("  vertex {} {} {}\n", p.x(), p.y(), p.z());
  out.text(" endloop\nendfacet\n");
}

void write_text(const MeshPieces& mesh, Sink& sink) {
  TextWriter out(sink);
  if (mesh.patches == 0) out.text("solid mesh\n");
  for_each_patch(mesh, [&](const MeshPiece& piece, const Patch& patch, std::size_t number) {
    if (mesh.patches > 0) out.print("solid patch_{}\n", number);
    for (std::size_t t = patch.first_triangle; t < patch.first_triangle + patch.triangle_count; ++t) {
      write_facet(corners_of(piece, t), out);
    }
    if (mesh.patches > 0) out.print("endsolid patch_{}\n", number);
  });
  if (mesh.patches == 0) out.text("endsolid mesh\n");
  out.flush();
}

}  // namespace

void write_stl(const MeshPieces& mesh, const MeshWriteOptions& options, Sink& sink,
               std::vector<Diagnostic>& notes) {
  if (options.binary) {
    write_binary(mesh, sink, notes);
  } else {
    write_text(mesh, sink);
  }
}

}  // namespace meshcontour::detail

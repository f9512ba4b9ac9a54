#include "base/text_writer.hpp"
#include "write/mesh_pieces.hpp"

namespace meshcontour::detail {

void write_obj_mesh(const MeshPieces& mesh, Sink& sink) {
  TextWriter out(sink);
  for_each_point(mesh, [&](const Point& p) { out.print("v {} {} {}\n", p.x(), p.y(), p.z()); });
  for_each_patch(mesh, [&](const MeshPiece& piece, const Patch& patch, std::size_t number) {
    if (mesh.patches > 0) out.print("g patch_{}\n", number);
    for_each_triangle(piece, patch,
                      [&](auto a, auto b, auto c) { out.print("f {} {} {}\n", a + 1, b + 1, c + 1); });
  });
  out.flush();
}

}  // namespace meshcontour::detail

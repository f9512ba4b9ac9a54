#include "base/text_writer.hpp"
#include "write/mesh_pieces.hpp"

namespace meshcontour::detail {

void write_off(const MeshPieces& mesh, Sink& sink) {
  TextWriter out(sink);
  out.print("OFF\n{} {} 0\n", mesh.points, mesh.triangles);
  for_each_point(mesh, [&](const Point& p) { out.print("{} {} {}\n", p.x(), p.y(), p.z()); });
  for_each_patch(mesh, [&](const MeshPiece& piece, const Patch& patch, std::size_t number) {
    const Rgba color = mesh.color(patch, number);
    const std::string tail =
        mesh.patches > 0 ? fmt::format(" {} {} {}\n", color.red, color.green, color.blue) : "\n";
    for_each_triangle(piece, patch,
                      [&](auto a, auto b, auto c) { out.print("3 {} {} {}{}", a, b, c, tail); });
  });
  out.flush();
}

}  // namespace meshcontour::detail

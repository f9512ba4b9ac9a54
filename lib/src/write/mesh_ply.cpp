#include <fmt/format.h>

#include <limits>

#include "base/text_writer.hpp"
#include "write/byte_buffer.hpp"
#include "write/mesh_pieces.hpp"

namespace meshcontour::detail {
namespace {

std::string header(const MeshPieces& mesh, const MeshWriteOptions& options) {
  return fmt::format(
      "ply\nformat {} 1.0\ncomment meshcontour\nelement vertex {}\nproperty double x\nproperty double y\n"
      "property double z\nelement face {}\nproperty list uchar int vertex_indices\nproperty int "
      "patch\n{}end_header\n",
      options.binary ? "binary_little_endian" : "ascii", mesh.points, mesh.triangles,
      options.colors ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "");
}

void write_binary(const MeshPieces& mesh, const MeshWriteOptions& options, Sink& sink) {
  ByteBuffer out(sink);
  out.put_text(header(mesh, options));
  for_each_point(mesh, [&](const Point& point) {
    for (const double value : point) out.put(value);
    out.flush_if_full();
  });
  for_each_patch(mesh, [&](const MeshPiece& piece, const Patch& patch, std::size_t number) {
    for_each_triangle(piece, patch, [&](auto... corners) {
      out.put(std::uint8_t{3});
      (out.put(static_cast<std::int32_t>(corners)), ...);
      out.put(static_cast<std::int32_t>(number));
      if (options.colors) {
        for (const std::uint8_t value : {patch.color.red, patch.color.green, patch.color.blue})
          out.put(value);
      }
      out.flush_if_full();
    });
  });
  out.flush();
}

void write_text(const MeshPieces& mesh, const MeshWriteOptions& options, Sink& sink) {
  TextWriter out(sink);
  out.text(header(mesh, options));
  for_each_point(mesh, [&](const Point& p) { out.print("{} {} {}\n", p.x(), p.y(), p.z()); });
  for_each_patch(mesh, [&](const MeshPiece& piece, const Patch& patch, std::size_t number) {
    const Rgba& color = patch.color;
    std::string tail = fmt::format(" {}", number);
    if (options.colors) tail += fmt::format(" {} {} {}", color.red, color.green, color.blue);
    for_each_triangle(piece, patch,
                      [&](auto a, auto b, auto c) { out.print("3 {} {} {}{}\n", a, b, c, tail); });
  });
  out.flush();
}

}  // namespace

void write_ply(const MeshPieces& mesh, const MeshWriteOptions& options, Sink& sink) {
  check_count(mesh.points, std::numeric_limits<std::int32_t>::max(), "points");
  if (options.binary) {
    write_binary(mesh, options, sink);
  } else {
    write_text(mesh, options, sink);
  }
}

}  // namespace meshcontour::detail

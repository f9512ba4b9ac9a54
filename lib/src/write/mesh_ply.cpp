#include <fmt/format.h>

#include <limits>

#include "base/text_writer.hpp"
#include "write/byte_buffer.hpp"
#include "write/mesh_pieces.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::string_view kPatchProperties =
    "property int patch\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n";

std::string header(const MeshPieces& mesh, bool binary) {
  return fmt::format(
      "ply\nformat {} 1.0\ncomment meshcontour\nelement vertex {}\nproperty double x\nproperty double y\n"
      "property double z\nelement face {}\nproperty list uchar int vertex_indices\n{}end_header\n",
      binary ? "binary_little_endian" : "ascii", mesh.points, mesh.triangles,
      mesh.patches > 0 ? kPatchProperties : "");
}

void write_binary(const MeshPieces& mesh, Sink& sink) {
  ByteBuffer out(sink);
  out.put_text(header(mesh, true));
  for_each_point(mesh, [&](const Point& point) {
    for (const double value : point) out.put(value);
    out.flush_if_full();
  });
  for_each_patch(mesh, [&](const MeshPiece& piece, const Patch& patch, std::size_t number) {
    const Rgba color = mesh.color(patch, number);
    for_each_triangle(piece, patch, [&](auto... corners) {
      out.put(std::uint8_t{3});
      (out.put(static_cast<std::int32_t>(corners)), ...);
      if (mesh.patches > 0) {
        out.put(static_cast<std::int32_t>(number));
        for (const std::uint8_t channel : {color.red, color.green, color.blue}) out.put(channel);
      }
      out.flush_if_full();
    });
  });
  out.flush();
}

void write_text(const MeshPieces& mesh, Sink& sink) {
  TextWriter out(sink);
  out.text(header(mesh, false));
  for_each_point(mesh, [&](const Point& p) { out.print("{} {} {}\n", p.x(), p.y(), p.z()); });
  for_each_patch(mesh, [&](const MeshPiece& piece, const Patch& patch, std::size_t number) {
    const Rgba color = mesh.color(patch, number);
    std::string tail;
    if (mesh.patches > 0) tail = fmt::format(" {} {} {} {}", number, color.red, color.green, color.blue);
    for_each_triangle(piece, patch,
                      [&](auto a, auto b, auto c) { out.print("3 {} {} {}{}\n", a, b, c, tail); });
  });
  out.flush();
}

}  // namespace

void write_ply(const MeshPieces& mesh, const MeshWriteOptions& options, Sink& sink) {
  check_count(mesh.points, std::numeric_limits<std::int32_t>::max(), "points");
  if (options.binary) {
    write_binary(mesh, sink);
  } else {
    write_text(mesh, sink);
  }
}

}  // namespace meshcontour::detail

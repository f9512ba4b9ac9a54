#include "meshcontour/mesh_write.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

#include "write/mesh_pieces.hpp"

namespace meshcontour {

using namespace detail;

std::optional<MeshFormat> mesh_format(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, MeshFormat>, 4> kFormats = {{{"off", MeshFormat::Off},
                                                                                {"obj", MeshFormat::Obj},
                                                                                {"stl", MeshFormat::Stl},
                                                                                {"ply", MeshFormat::Ply}}};
  if (name.starts_with('.')) name.remove_prefix(1);
  std::string lower(name);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  for (const auto& [extension, format] : kFormats) {
    if (lower == extension) return format;
  }
  return std::nullopt;
}

void write_mesh(MeshFormat format, const Model& model, const MeshWriteOptions& options, Sink& sink,
                std::vector<Diagnostic>& notes) {
  const MeshPieces mesh(model);
  switch (format) {
    case MeshFormat::Off:
      return write_off(mesh, options, sink);
    case MeshFormat::Obj:
      return write_obj_mesh(mesh, sink);
    case MeshFormat::Stl:
      return write_stl(mesh, options, sink, notes);
    case MeshFormat::Ply:
      return write_ply(mesh, options, sink);
  }
}

namespace detail {

MeshPieces::MeshPieces(const Model& model) {
  std::size_t patches = 0;
  for (const Instance& instance : model.instances) {
    const Shell& shell = model.shells[instance.shell];
    MeshPiece piece{shell, instance};
    piece.moved = instance.placement.matrix() != Eigen::Matrix4d::Identity();
    piece.mirrored = instance.placement.linear().determinant() < 0;
    piece.first_point = points;
    piece.first_patch = patches;
    pieces.push_back(piece);
    points += shell.points.size();
    triangles += shell.triangles.size();
    patches += shell.patches.size();
  }
}

void check_count(std::uint64_t count, std::uint64_t largest, std::string_view what) {
  if (count <= largest) return;
  throw Error(ErrorCode::BadData, fmt::format("{} {}, but the format can hold {}", count, what, largest));
}

}  // namespace detail
}  // namespace meshcontour

#include "meshcontour/mesh_write.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

#include "write/mesh_pieces.hpp"

namespace meshcontour {

using namespace detail;

std::optional<MeshFormat> mesh_format(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, MeshFormat>, 5> kFormats = {{{"off", MeshFormat::Off},
                                                                                {"obj", MeshFormat::Obj},
                                                                                {"stl", MeshFormat::Stl},
                                                                                {"ply", MeshFormat::Ply},
                                                                                {"net", MeshFormat::Net}}};
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
  const MeshPieces mesh(model, options);
  switch (format) {
    case MeshFormat::Off:
      return write_off(mesh, sink);
    case MeshFormat::Obj:
      return write_obj_mesh(mesh, sink);
    case MeshFormat::Stl:
      return write_stl(mesh, options, sink, notes);
    case MeshFormat::Ply:
      return write_ply(mesh, options, sink);
    case MeshFormat::Net:
      return write_net(mesh, model, options, sink);
  }
}

namespace detail {

MeshPieces::MeshPieces(const Model& model, const MeshWriteOptions& options) {
  const Rgba* first_color = nullptr;
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
    for (const Patch& patch : shell.patches) {
      if (first_color == nullptr) first_color = &patch.color;
      one_color = one_color && patch.color == *first_color;
    }
  }
  if (!options.patches || patches == 1) patches = 0;
}

Rgba MeshPieces::color(const Patch& patch, std::size_t number) const {
  if (!one_color) return patch.color;
  // Multiples of an odd number differ modulo 2^24.
  const std::uint32_t mixed = static_cast<std::uint32_t>(number) * 0x9E3779;
  const auto channel = [&](int shift) { return static_cast<std::uint8_t>(mixed >> shift); };
  return {channel(16), channel(8), channel(0), 255};
}

void check_count(std::uint64_t count, std::uint64_t largest, std::string_view what) {
  if (count <= largest) return;
  throw Error(ErrorCode::BadData, fmt::format("{} {}, but the format can hold {}", count, what, largest));
}

}  // namespace detail
}  // namespace meshcontour

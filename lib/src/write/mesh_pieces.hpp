#pragma once

#include <cstdint>
#include <vector>

#include "meshcontour/mesh_write.hpp"

namespace meshcontour::detail {

/// One instance of a shell, as it stands in a mesh file.
struct MeshPiece {
  const Shell& shell;
  const Instance& instance;
  bool moved = false;             ///< the placement is not the identity
  bool mirrored = false;          ///< triangles are turned
  std::uint64_t first_point = 0;  ///< points of the pieces before
  std::size_t first_patch = 0;    ///< patches of the pieces before

  Point point(Index v) const { return moved ? Point(instance.placement * shell.points[v]) : shell.points[v]; }
  Triangle triangle(std::size_t t) const {
    const Triangle& c = shell.triangles[t];
    return mirrored ? Triangle{c[0], c[2], c[1]} : c;
  }
};

/// All instances of a model in order, with sums of what they hold; patches only if they are to be kept.
struct MeshPieces {
  MeshPieces(const Model& model, const MeshWriteOptions& options);

  std::vector<MeshPiece> pieces;
  std::uint64_t points = 0, triangles = 0;
  std::size_t patches = 0;
  bool one_color = true;  ///< all patches have the same

  /// The colour of a patch, told apart from the others where the model does not.
  Rgba color(const Patch& patch, std::size_t number) const;
};

/// Calls visit(point) for the points of all instances.
template <typename Visit>
void for_each_point(const MeshPieces& mesh, Visit&& visit) {
  for (const MeshPiece& piece : mesh.pieces) {
    for (Index v = 0; v < piece.shell.points.size(); ++v) visit(piece.point(v));
  }
}

/// Calls visit(piece, patch, number) for the patches of all instances, kept or not; numbers from 1.
template <typename Visit>
void for_each_patch(const MeshPieces& mesh, Visit&& visit) {
  for (const MeshPiece& piece : mesh.pieces) {
    for (std::size_t n = 0; n < piece.shell.patches.size(); ++n) {
      visit(piece, piece.shell.patches[n], piece.first_patch + n + 1);
    }
  }
}

/// Calls visit(a, b, c) for the triangles of a patch, with the numbers of points over all instances, from 0.
template <typename Visit>
void for_each_triangle(const MeshPiece& piece, const Patch& patch, Visit&& visit) {
  for (std::size_t t = patch.first_triangle; t < patch.first_triangle + patch.triangle_count; ++t) {
    const auto [a, b, c] = piece.triangle(t);
    visit(piece.first_point + a, piece.first_point + b, piece.first_point + c);
  }
}

/// @throws Error  BadData if a count is above what the format can hold.
void check_count(std::uint64_t count, std::uint64_t largest, std::string_view what);

void write_off(const MeshPieces& mesh, Sink& sink);
void write_obj_mesh(const MeshPieces& mesh, Sink& sink);
void write_stl(const MeshPieces& mesh, const MeshWriteOptions& options, Sink& sink,
               std::vector<Diagnostic>& notes);
void write_net(const MeshPieces& mesh, const Model& model, const MeshWriteOptions& options, Sink& sink);
void write_ply(const MeshPieces& mesh, const MeshWriteOptions& options, Sink& sink);

}  // namespace meshcontour::detail

#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "meshcontour/wavelet.hpp"

namespace meshcontour {

struct RemeshOptions {
  unsigned most_levels = 6;          ///< of subdivision, 1 to 8; fewer where patches are small
  std::size_t base_triangles = 200;  ///< of the base mesh about, up to four times as many; more where
                                     ///< patches, topology or the tolerance need them
  double tolerance = 0;  ///< distance of both surfaces at which base triangles become finer, as far as that
                         ///< helps; 0: 0.5 % of the box diagonal; model units
  unsigned threads = 0;  ///< 0: one per processor
};

/// A place on a triangle of a shell: shares of its corners, none below 0, with sum 1.
struct SurfacePlace {
  Index triangle = 0;
  std::array<double, 3> weights{};
};

/// A shell as a subdivision mesh.
struct Remesh {
  Shell shell;  ///< points and triangles in the order of subdivided(); no corner normals, no creases
  SubdivisionConnectivity connectivity;  ///< of that shell
  std::vector<SurfacePlace> places;      ///< of each of its points, on the shell that it was made of
  std::size_t flipped = 0;               ///< triangles that are turned over, beside the surface there
  double error = 0;                      ///< patch_distance() of both shells, an upper bound; model units
};

/// Covers any surface with a mesh that comes from subdivisions: its own edges are collapsed to a base mesh,
/// with a map between the two all the while, and the vertices of the subdivided base mesh go where that map
/// takes them, on the surface. [Lee et al. 1998; Liu et al. 2020]
///
/// Patches keep their numbers, and their boundary loops number, order and first vertex. Vertices of borders,
/// patch borders and creases lie on these, and every vertex that these had is among them. There are about
/// four times as many triangles; at most sixteen times as many, of large surfaces eight times. O(n log n).
///
/// @throws Error  Usage if an option is out of range; BadData if the shell has no triangles or is not an
///                orientable manifold (naming the vertex).
Remesh remeshed(const Shell& shell, const RemeshOptions& options = {});

/// The remeshes of a model's shells.
struct ModelRemesh {
  /// One a shell; nothing where the triangles come from a subdivision, where there are none, and where they
  /// are no orientable manifold.
  std::vector<std::optional<Remesh>> shells;
  std::vector<Diagnostic> notes;  ///< for each shell that was remeshed, and for each that could not be
};

/// Remeshes the shells of a model whose triangles come from no subdivision.
///
/// @throws Error  Usage if an option is out of range.
ModelRemesh remeshed_model(const Model& model, const RemeshOptions& options = {});

/// The model with remeshes in the place of the shells that have one.
///
/// @param remesh  of this model.
Model with_remeshed_shells(const Model& model, const ModelRemesh& remesh);

/// detail_sizes() of a remesh, what of the coefficients lies along the surface left out: of each point of the
/// shell the largest on the triangles around it.
///
/// @param remesh  of this shell.
std::vector<double> remeshed_detail_sizes(const Shell& shell, const Remesh& remesh,
                                          const SubdivisionOptions& subdivide = {});

}  // namespace meshcontour

#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "meshcontour/model.hpp"
#include "meshcontour/output.hpp"
#include "meshcontour/subdivision.hpp"

namespace meshcontour {

struct WaveletStreamOptions {
  /// Step of the finest coefficients along the normal, as a share of a shell's box diagonal, in (0, 1). Along
  /// the surface it is four times as large, at each coarser level half.
  double precision = 1e-6;
  SubdivisionOptions subdivide;
};

/// Writes a model as a progressive stream: first the coarse meshes, whole, then blocks of wavelet
/// coefficients, the largest of all shells first and of these the coarser levels first, as multiples of a
/// step. Blocks are compressed and carry checksums. Any beginning of the stream that has the coarse meshes
/// can be read.
///
/// Shells whose triangles come from no subdivision are their own coarse mesh. Patches, colours and instances
/// are kept, normals, annotations and curves are not. Triangles and points come back in the order of
/// subdivided().
///
/// @throws Error  Usage if the precision is out of range; InputOutput from the sink.
void write_wavelet_stream(const Model& model, const WaveletStreamOptions& options, Sink& sink,
                          std::vector<Diagnostic>& notes);

/// Whether bytes begin like a wavelet stream.
bool is_wavelet_stream(std::string_view head);

/// Reads a stream, or the beginning of one. Where it ends early the finest level is that of the finest
/// coefficient, and a warning says how many are missing.
///
/// @param name           of the input, for messages.
/// @param max_triangles  of all shells together.
/// @throws Error  BadData if the bytes are no stream, end before the coarse meshes do, or are damaged;
/// OutOfMemory if
///                they ask for more than the limit.
Model read_wavelet_stream(std::string_view bytes, std::string_view name, std::uint64_t max_triangles,
                          unsigned threads = 0);

}  // namespace meshcontour

#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "meshcontour/model.hpp"
#include "meshcontour/output.hpp"

namespace meshcontour {

/// Files that hold a mesh.
enum class MeshFormat { Off, Obj, Stl, Ply, Net };

/// The format of a name or extension, in any case, with or without dot: "ply", ".STL".
std::optional<MeshFormat> mesh_format(std::string_view name);

struct MeshWriteOptions {
  bool binary = true;  ///< STL and PLY; OFF and OBJ are text always
  /// Patches are kept, where there is more than one; false: triangles only, which the simplest readers take.
  bool patches = true;
  bool single_precision = false;  ///< numbers of net files; reads back as the nearest float
};

/// Writes the triangles of every instance, placed; memory is bounded by one buffer.
///
/// Points keep their order, the unused ones too, so that vertex numbers of tables are those of the file; STL,
/// which has none, gives them back by first appearance when it is read. Coordinates are written so that they
/// read back the same, but for binary STL, which is in single precision. Triangles of mirrored instances are
/// turned.
///
/// Patches are kept as groups `patch_N` (N from 1, over all instances) in OBJ, as solids of the same name in
/// text STL, as the face property `patch` in PLY, and by a colour a face in OFF and PLY; where all have the
/// same colour each gets one of its own. Binary STL and net have none. A net keeps the textures, the colours
/// and texture coordinates of points, and polygons for as long as their triangles are unchanged; a line of it
/// has at most 79 bytes, as old readers need it, unless colours have tiny numbers.
///
/// @param notes   findings are appended: triangles that collapse in single precision.
/// @throws Error  InputOutput from the sink; BadData if a coordinate does not fit single precision, or there
/// are more
///                triangles or points than the format can count.
void write_mesh(MeshFormat format, const Model& model, const MeshWriteOptions& options, Sink& sink,
                std::vector<Diagnostic>& notes);

/// Files that hold lines.
enum class LineFormat {
  Obj,  ///< `l` elements, an object a name
  Wrl,  ///< VRML 2.0, an indexed line set
};

/// Writes lines, e.g. spanning trees and shortest paths, see graph.hpp.
///
/// @throws Error  InputOutput from the sink.
void write_lines(LineFormat format, std::span<const Polyline> lines, Sink& sink);

}  // namespace meshcontour

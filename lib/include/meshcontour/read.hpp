#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "meshcontour/model.hpp"
#include "meshcontour/sweep.hpp"

namespace meshcontour {

/// How `.net` control meshes are read.
struct NetOptions {
  bool normalise = false;  ///< centred, and scaled so that the largest coordinate is 6
  bool strict = false;     ///< a point with fewer than 3 edges, or more than 16, is an error
  /// What repair_model mends (edges with three or more faces, faces that run the same way along an edge, bow
  /// ties) is a warning; without it, an error.
  bool mend = false;
};

/// Limits that keep a hostile file from exhausting the machine. Lengths are in the file's own unit.
struct ReadOptions {
  std::uint64_t max_triangles = 200'000'000;  ///< stored, and over all instances
  std::uint64_t max_instances = 1'000'000;
  bool strict = false;   ///< anything that would be mended with a warning is an error
  unsigned threads = 0;  ///< 0: one per processor
  NetOptions net;        ///< of control meshes
  SweepOptions sweep;    ///< of files that describe sweeps; the limit and the threads above rule there too
  /// Points of polygon files (STL, OBJ, PLY, OFF, net) no farther apart than this become one, see
  /// weld_points; vertex indices then mean the welded list. None: only STL is welded, where coordinates are
  /// equal.
  std::optional<double> weld;
};

/// Reads a file; the format follows its content, with the extension as a hint.
///
/// Coordinates are at most 1e101 in size, and 1e150 where a part is placed: products of lengths stay finite.
/// Files that it names are read only from the folder of the file itself or below.
///
/// @throws Error  NoInput if the file cannot be opened, BadData with file, line and element if it is wrong,
///                OutOfMemory if it asks for more than a limit.
Model read_model(const std::filesystem::path& file, const ReadOptions& options = {});

/// The extensions of all formats that can be read, lower case, without the dot.
std::vector<std::string> readable_extensions();

/// Reads a model from memory, e.g. standard input.
///
/// @param name    stands for the file in messages and gives the extension; files beside it are not read.
Model read_model(std::string_view bytes, std::string_view name, const ReadOptions& options = {});

}  // namespace meshcontour

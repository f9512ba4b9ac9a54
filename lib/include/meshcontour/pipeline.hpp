#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "meshcontour/boundary.hpp"
#include "meshcontour/fit.hpp"
#include "meshcontour/mesh_write.hpp"
#include "meshcontour/model.hpp"
#include "meshcontour/read.hpp"
#include "meshcontour/render.hpp"
#include "meshcontour/report.hpp"
#include "meshcontour/segmentation.hpp"
#include "meshcontour/simplification.hpp"
#include "meshcontour/subdivision.hpp"
#include "meshcontour/wavelet_stream.hpp"
#include "meshcontour/write.hpp"

namespace meshcontour {

/// One file to be written.
struct OutputRequest {
  std::string path;  ///< "-": standard output
  OutputFormat format = OutputFormat::Json;
  std::optional<View> view = std::nullopt;  ///< of a picture; else the job's
};

/// One file to write the mesh to.
struct MeshRequest {
  std::string path;  ///< "-": standard output
  MeshFormat format = MeshFormat::Ply;
};

/// The patches that outputs are restricted to.
struct PatchSelection {
  std::string shell;                                         ///< id; empty: all
  std::vector<std::pair<std::size_t, std::size_t>> patches;  ///< first and last, from 1; empty: all

  bool everything() const { return shell.empty() && patches.empty(); }
};

/// What to do with one input.
struct Job {
  std::string input;  ///< "-": standard input
  std::vector<OutputRequest> outputs;
  std::vector<MeshRequest> meshes;
  ReadOptions read;
  double input_unit = 0;  ///< metres per unit of the input, whatever it tells; 0: as it tells
  double unit = 0;        ///< metres per unit of everything after reading; 0: the input's
  bool repair = false;    ///< cut the surface apart where it is no manifold
  SegmentOptions segment;
  PatchSelection selection;
  std::vector<std::string>
      wavelets;  ///< files for the model as a progressive stream, before it is simplified
  WaveletStreamOptions wavelet;
  bool remesh = true;         ///< shells that come from no subdivision, for `wavelets` and the layer Detail
  unsigned subdivisions = 0;  ///< steps of butterfly subdivision
  SubdivisionOptions subdivide;
  SimplifyOptions simplify;  ///< after that
  BoundaryOptions boundary;
  FitOptions fit;
  std::optional<Index> path_from,
      path_to;  ///< ends of Model::path, vertices of the chosen shell; both or none
  RenderOptions render;
  WriteOptions write;
  MeshWriteOptions mesh;
  bool preview = false;     ///< make Run::preview
  bool always_fit = false;  ///< fits curves even where no output shows them, so that a report has their times
  bool timings_in_json =
      false;  ///< lists the stages' times in JSON outputs, whose bytes then change from run to run
};

/// What one job gave.
struct Run {
  Model model;
  std::vector<ShellBoundary> boundaries;
  std::vector<Contour> contours;
  std::vector<Simplification> simplifications;  ///< one a shell, if that was asked for
  std::vector<Diagnostic> diagnostics;
  Timings timings;
  Preview preview;  ///< for a page, see ReportFormat::Html
};

/// Reads, cleans, segments, refines, simplifies, extracts, fits, draws and writes: the one place that knows
/// the order of the stages and times them.
///
/// All outputs appear together once everything has succeeded, or none does.
///
/// Model::tree and Model::path are made when an output shows them; the path also when only its ends are
/// given, so that its length is told in a note.
///
/// @throws Error  of any stage; Usage if the selection names a shell or patch that is not there, or the ends
/// of a path
///                are wrong.
Run run(const Job& job);

}  // namespace meshcontour

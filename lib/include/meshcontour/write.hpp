#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "meshcontour/boundary.hpp"
#include "meshcontour/curve.hpp"
#include "meshcontour/output.hpp"
#include "meshcontour/render.hpp"
#include "meshcontour/report.hpp"

namespace meshcontour {

/// What a run has produced, as the writers see it. Views: what they name must live as long.
struct Result {
  const Model& model;
  std::span<const ShellBoundary> boundaries;  ///< parallel to Model::shells
  std::span<const Contour> contours;  ///< in order of shell, patch and loop; loops without one are written as
                                      ///< polygons
  std::string_view extractor = "sorted";
  std::span<const Diagnostic> diagnostics = {};  ///< listed in JSON
  std::span<const StageTime> timings = {};       ///< listed in JSON; leave empty for bytes that never change
};

/// The kinds of output. A picture is drawn (render.hpp); write_output writes all others.
enum class OutputFormat { Png, Csv, Obj, Step, Dxf, Svg, Json, Glb, Wrl };

/// The format of a name or extension, in any case, with or without dot: "csv", ".STEP", "stp".
std::optional<OutputFormat> output_format(std::string_view name);

/// The names of all formats, for help and messages.
std::span<const std::string_view> output_format_names();

enum class CsvContent { Loops, Curves };
enum class ObjContent {
  Polylines,  ///< loops
  Curves,     ///< fitted loops
  Tree,       ///< Model::tree
  Path,       ///< Model::path
};
enum class WrlContent { Tree, Path };
enum class DxfContent {
  Curves,    ///< LINE, ARC, CIRCLE, ELLIPSE and SPLINE
  Polyline,  ///< one polyline a loop: flat loops as LWPOLYLINE, arcs as bulges; others as 3D POLYLINE
};
enum class StepSchema { Ap242, Ap214 };
enum class EdgeUse {
  All,     ///< every patch with all its edges
  Unique,  ///< an edge that two patches share is written once; in geometry files, not in tables
};

struct WriteOptions {
  CsvContent csv = CsvContent::Loops;
  ObjContent obj = ObjContent::Polylines;
  WrlContent wrl = WrlContent::Tree;
  DxfContent dxf = DxfContent::Curves;
  StepSchema step = StepSchema::Ap242;
  EdgeUse edges = EdgeUse::All;
  View view = View::Iso;  ///< of an SVG; Report counts as Iso
  UpAxis up = UpAxis::Z;  ///< of that view
  std::int64_t timestamp =
      946'684'800;  ///< in the headers of STEP and DXF, seconds since 1970 UTC; 2000-01-01
};

/// The environment's SOURCE_DATE_EPOCH, for WriteOptions::timestamp; nothing if it is not set.
///
/// @throws Error   Usage if it is no whole number of seconds up to the year 9999.
std::optional<std::int64_t> source_date_epoch();

/// Writes a result; memory is bounded by one patch, whatever the size of the model, but for Glb, which is
/// kept whole.
///
/// Tables (Csv, Json) list each shell once, in its own frame; geometry (Obj, Step, Dxf, Svg, Glb) holds every
/// instance, placed, and the model's annotations and curves. Lengths are in model units, but for Glb. The
/// bytes depend on the arguments alone.
///
/// - Csv: `loops` has a row a loop vertex: shell id, patch and loop from 1, closed 1 or 0, index in the loop
/// from 0,
///   vertex of the shell from 0, x, y, z. `curves` has a row a segment: type line, arc, circle, ellipse or
///   bspline, degree and number of control points of a bspline, the ends, the radius of an arc or circle, and
///   its deviation.
/// - Obj: an object a loop, `shell_ID_patch_P_loop_L`, with `_instance_N` where the shell occurs more than
/// once; as
///   polylines through the vertices, or as clamped (rational) B-spline curves, one a segment.
///   The tree and the path are polylines along edges. Wrl: VRML 2.0 line sets of these.
/// - Step: one geometric curve set a patch, one (composite) curve a loop. Dxf: one layer a patch, one group a
/// loop.
///   Svg: one group a patch, one path a loop, seen from `view` without perspective.
/// - Glb: glTF 2.0 in one file. A root node turns z up to y up and model units (unknown: millimetres) to
/// metres; below it
///   is a node an instance, with the mesh of its shell: a lit primitive a patch, `extras.patch` its number
///   from 1 and `extras.name` its name; nodes `edges` and `curves` below that hold the loops' polygons and
///   the fitted contours as lines, again a primitive a patch. Nodes of one shell share these meshes unless a
///   placement shears. Single precision, relative to the middle of the shell.
/// - Json: counts, instances, patches with loops and segments exactly, diagnostics and timings. A loop's
/// length is that
///   of its polygon.
///
/// @param notes    findings are appended: loops that a format can hold only approximately, an unknown unit.
/// @throws Error   InputOutput from the sink; Internal for Png; BadData if a Glb would have more than 4 GB or
/// a
///                 coordinate does not fit single precision.
void write_output(OutputFormat format, const Result& result, const WriteOptions& options, Sink& sink,
                  std::vector<Diagnostic>& notes);

}  // namespace meshcontour

// GLB: each shell once, its faces, edges and curves as meshes of a primitive a patch; each instance a node.

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "base/escape.hpp"
#include "model/normals.hpp"
#include "write/glb_file.hpp"
#include "write/sampling.hpp"
#include "write/units.hpp"
#include "write/writers.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kChordTolerance = 1e-4;  // of the curve's size, as for fits
constexpr double kMostShear = 1e-6;       // cosine between the axes of a placement that a node can hold
constexpr double kMillimetre = 1e-3;
constexpr int kLines = 1;  // the mode of a primitive
constexpr Rgba kEdges{40, 40, 44, 255}, kCurves{214, 0, 110, 255},
    kAnnotations{60, 60, 150, 255};  // as in pictures

using Vertex = Eigen::Vector3f;

// Positions are relative to a centre nearby: single precision is enough there.
Vertex position(const Point& point, const Point& centre) {
  const Vertex rounded = (point - centre).cast<float>();
  if (!rounded.allFinite()) throw Error(ErrorCode::BadData, "a coordinate is too large for .glb");
  return rounded;
}

std::string matrix_text(const Eigen::Affine3d& placement) {
  if (!placement.matrix().allFinite()) throw Error(ErrorCode::BadData, "a placement is too large for .glb");
  if (placement.matrix() == Eigen::Matrix4d::Identity()) return "";
  return fmt::format(",\"matrix\":[{}]", fmt::join(placement.matrix().reshaped(), ","));
}

// A node's matrix must be a product of translation, rotation and scale.
bool fits_node(const Eigen::Affine3d& placement) {
  const Eigen::Matrix3d axes = placement.linear().colwise().normalized();
  const Eigen::Matrix3d cosines = axes.transpose() * axes - Eigen::Matrix3d::Identity();
  return placement.linear().determinant() != 0 && cosines.cwiseAbs().maxCoeff() <= kMostShear;
}

Shell placed(const Shell& shell, const Eigen::Affine3d& placement) {
  Shell out = shell;
  for (Point& p : out.points) p = placement * p;
  out.corner_normals.clear();
  if (placement.linear().determinant() < 0) {
    for (Triangle& t : out.triangles) std::swap(t[1], t[2]);
  }
  return out;
}

// The corners of one patch as vertices: corners with the same point and normal are one.
class CornerNumbering {
 public:
  explicit CornerNumbering(std::size_t points) : newest_(points, kNone) {}

  std::uint32_t number(Index point, const Vertex& at, const Vertex& normal) {
    std::uint32_t vertex = newest_[point];
    for (int compared = 0; vertex != kNone && compared < kCompared; ++compared, vertex = older_[vertex]) {
      if (normals[vertex] == normal) return vertex;
    }
    const auto fresh = static_cast<std::uint32_t>(positions.size());
    positions.push_back(at);
    normals.push_back(normal);
    points_.push_back(point);
    older_.push_back(newest_[point]);
    return newest_[point] = fresh;
  }

  void clear() {
    for (const Index point : points_) newest_[point] = kNone;
    positions.clear();
    normals.clear();
    points_.clear();
    older_.clear();
  }

  std::vector<Vertex> positions, normals;

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  static constexpr int kCompared =
      8;  // normals of a point; with more of them some vertices are written twice

  std::vector<std::uint32_t> newest_, older_;
  std::vector<Index> points_;
};

// Lines of one primitive.
struct Lines {
  std::vector<Vertex> positions;
  std::vector<std::uint32_t> indices;

  void add(const std::vector<Point>& points, bool closed, const Point& centre) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const Point& p : points) positions.push_back(position(p, centre));
    const auto end = static_cast<std::uint32_t>(positions.size());
    for (std::uint32_t i = first; i + 1 < end; ++i) indices.insert(indices.end(), {i, i + 1});
    if (closed && end - first > 2) indices.insert(indices.end(), {end - 1, first});
  }

  void add(const Chain& chain, const Point& centre) {
    add(chain_points(chain, kChordTolerance * chain_size(chain)), chain.closed, centre);
  }
};

std::string patch_extras(const Shell& shell, std::size_t patch) {
  const std::string& name = shell.patches[patch].name;
  return fmt::format(",\"extras\":{{\"patch\":{}{}}}", patch + 1,
                     name.empty() ? "" : ",\"name\":" + json_quoted(name));
}

// What nodes share: the meshes of a shell, in its own frame, or placed where a node cannot hold the
// placement.
struct Part {
  Point centre = Point::Zero();      // the origin of its coordinates
  std::optional<std::size_t> faces;  // meshes, if it has any
  std::vector<std::pair<std::string_view, std::size_t>> lines;
};

class GlbWriter {
 public:
  explicit GlbWriter(const Result& result) : result_(result), model_(result.model) {}

  void add_instances(EdgeUse edges);
  void add_drawing(std::string_view name, const std::vector<Chain>& chains, const Rgba& color);
  void write(Sink& sink);

 private:
  void choose_parts();
  void add_faces(std::size_t part);
  std::string patch_primitive(const Shell& shell, std::size_t patch, const Part& part,
                              const std::vector<Vertex>& normals, CornerNumbering& corners);
  void add_lines(EdgeUse edges, LoopShape shape, std::string_view name, const Rgba& color);
  std::string line_primitive(const Lines& lines, std::size_t material, const std::string& extras);
  void add_nodes(const Instance& instance, std::size_t part);
  std::size_t add_mesh(const std::string& name, const JsonArray& primitives);

  const Result& result_;
  const Model& model_;
  GlbFile file_;
  std::vector<Part> parts_;
  std::vector<Instance> places_;       // of the parts
  std::vector<std::size_t> part_of_;   // for each instance of the model
  std::vector<std::size_t> children_;  // of the root
};

void GlbWriter::choose_parts() {
  std::vector<std::optional<std::size_t>> shared(model_.shells.size());
  for (const Instance& instance : model_.instances) {
    const bool fits = fits_node(instance.placement);
    if (!fits || !shared[instance.shell]) {
      if (fits) shared[instance.shell] = places_.size();
      part_of_.push_back(places_.size());
      places_.push_back({instance.shell, fits ? Eigen::Affine3d::Identity() : instance.placement, {}});
    } else {
      part_of_.push_back(*shared[instance.shell]);
    }
  }
  parts_.resize(places_.size());
}

std::size_t GlbWriter::add_mesh(const std::string& name, const JsonArray& primitives) {
  return file_.add_mesh(
      fmt::format("{{\"name\":{},\"primitives\":{}}}", json_quoted(name), primitives.text()));
}

std::string GlbWriter::patch_primitive(const Shell& shell, std::size_t patch, const Part& part,
                                       const std::vector<Vertex>& normals, CornerNumbering& corners) {
  corners.clear();
  std::vector<std::uint32_t> indices;
  const auto [name, color, first, count] = shell.patches[patch];
  for (std::size_t c = 3 * first; c < 3 * (first + count); ++c) {
    const Index point = shell.triangles[c / 3][c % 3];
    indices.push_back(corners.number(point, position(shell.points[point], part.centre), normals[c]));
  }
  const std::size_t at = file_.add_positions(corners.positions), normal = file_.add_normals(corners.normals),
                    index = file_.add_indices(indices), material = file_.surface(color);
  return fmt::format("{{\"attributes\":{{\"POSITION\":{},\"NORMAL\":{}}},\"indices\":{},\"material\":{}{}}}",
                     at, normal, index, material, patch_extras(shell, patch));
}

void GlbWriter::add_faces(std::size_t number) {
  const Instance& place = places_[number];
  const bool identity = place.placement.matrix() == Eigen::Matrix4d::Identity();
  const Shell moved = identity ? Shell() : placed(model_.shells[place.shell], place.placement);
  const Shell& shell = identity ? model_.shells[place.shell] : moved;
  Part& part = parts_[number];
  const Box box = bounding_box(shell);
  if (!box.isEmpty()) part.centre = box.min() + box.sizes() / 2;
  const std::vector<Vertex> normals = lighting_normals(shell, 0);
  CornerNumbering corners(shell.points.size());
  JsonArray primitives;
  for (std::size_t p = 0; p < shell.patches.size(); ++p) {
    if (shell.patches[p].triangle_count > 0)
      primitives.add(patch_primitive(shell, p, part, normals, corners));
  }
  if (!primitives.empty()) part.faces = add_mesh("shell_" + shell.id, primitives);
}

std::string GlbWriter::line_primitive(const Lines& lines, std::size_t material, const std::string& extras) {
  const std::size_t at = file_.add_positions(lines.positions), index = file_.add_indices(lines.indices);
  return fmt::format("{{\"attributes\":{{\"POSITION\":{}}},\"indices\":{},\"mode\":{},\"material\":{}{}}}",
                     at, index, kLines, material, extras);
}

void GlbWriter::add_lines(EdgeUse edges, LoopShape shape, std::string_view name, const Rgba& color) {
  std::vector<JsonArray> primitives(parts_.size());
  for_each_patch_group(result_, places_, edges, shape, [&](std::size_t part, const Group& group) {
    Lines lines;
    for (const Chain& chain : group.chains) lines.add(chain, parts_[part].centre);
    if (lines.indices.empty()) return;
    const Shell& shell = model_.shells[places_[part].shell];
    primitives[part].add(line_primitive(lines, file_.line(name, color), patch_extras(shell, group.patch)));
  });
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (primitives[i].empty()) continue;
    const std::string mesh = fmt::format("shell_{} {}", model_.shells[places_[i].shell].id, name);
    parts_[i].lines.emplace_back(name, add_mesh(mesh, primitives[i]));
  }
}

void GlbWriter::add_nodes(const Instance& instance, std::size_t number) {
  const Part& part = parts_[number];
  if (!part.faces && part.lines.empty()) return;
  std::vector<std::size_t> lines;
  for (const auto& [name, mesh] : part.lines) {
    lines.push_back(file_.add_node(fmt::format("{{\"name\":\"{}\",\"mesh\":{}}}", name, mesh)));
  }
  const bool placed_already = places_[number].placement.matrix() != Eigen::Matrix4d::Identity();
  const Eigen::Affine3d placement = placed_already ? Eigen::Affine3d::Identity() : instance.placement;
  const std::string name =
      instance.path.empty() ? "shell_" + model_.shells[instance.shell].id : instance.path;
  std::string node = fmt::format("{{\"name\":{}{}", json_quoted(name),
                                 matrix_text(placement * Eigen::Translation3d(part.centre)));
  if (part.faces) node += fmt::format(",\"mesh\":{}", *part.faces);
  if (!lines.empty()) node += fmt::format(",\"children\":[{}]", fmt::join(lines, ","));
  children_.push_back(file_.add_node(node + '}'));
}

void GlbWriter::add_instances(EdgeUse edges) {
  choose_parts();
  for (std::size_t i = 0; i < parts_.size(); ++i) add_faces(i);
  add_lines(edges, LoopShape::Polygon, "edges", kEdges);
  if (!result_.contours.empty()) add_lines(edges, LoopShape::Fitted, "curves", kCurves);
  for (std::size_t i = 0; i < model_.instances.size(); ++i) add_nodes(model_.instances[i], part_of_[i]);
}

void GlbWriter::add_drawing(std::string_view name, const std::vector<Chain>& chains, const Rgba& color) {
  std::vector<std::vector<Point>> points;
  Box box;
  for (const Chain& chain : chains) {
    points.push_back(chain_points(chain, kChordTolerance * chain_size(chain)));
    for (const Point& p : points.back()) box.extend(p);
  }
  if (box.isEmpty()) return;
  const Point centre = box.min() + box.sizes() / 2;
  JsonArray primitives;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    Lines lines;
    lines.add(points[i], chains[i].closed, centre);
    const std::string extras =
        chains[i].name.empty() ? "" : fmt::format(",\"extras\":{{\"name\":{}}}", json_quoted(chains[i].name));
    primitives.add(line_primitive(lines, file_.line(name, color), extras));
  }
  const std::size_t mesh = add_mesh(std::string(name), primitives);
  const Eigen::Affine3d placement(Eigen::Translation3d{centre});
  children_.push_back(
      file_.add_node(fmt::format("{{\"name\":\"{}\"{},\"mesh\":{}}}", name, matrix_text(placement), mesh)));
}

// glTF has metres and y up.
void GlbWriter::write(Sink& sink) {
  const double scale = model_.metres_per_unit > 0 ? model_.metres_per_unit : kMillimetre;
  const std::string children =
      children_.empty() ? "" : fmt::format(",\"children\":[{}]", fmt::join(children_, ","));
  const std::size_t root = file_.add_node(
      fmt::format("{{\"name\":{},\"matrix\":[{},0,0,0,0,0,{},0,0,{},0,0,0,0,0,1]{}}}",
                  json_quoted(model_.name.empty() ? "model" : model_.name), scale, -scale, scale, children));
  file_.write(root, sink);
}

}  // namespace

void write_glb(const Result& result, const WriteOptions& options, Sink& sink,
               std::vector<Diagnostic>& notes) {
  GlbWriter writer(result);
  writer.add_instances(options.edges);
  std::vector<Chain> annotations, curves;
  for (const Polyline& line : result.model.annotations) {
    if (line.points.size() > 1) annotations.push_back({line.name, false, {}, line.points});
  }
  for (const NamedCurve& curve : result.model.curves) {
    curves.push_back({curve.name, start_of(curve.curve) == end_of(curve.curve), {curve.curve}, {}});
  }
  writer.add_drawing("annotations", annotations, kAnnotations);
  writer.add_drawing("curves", curves, kCurves);
  writer.write(sink);
  if (!(result.model.metres_per_unit > 0)) note_unit("GLB", 0, "millimetre", notes);
}

}  // namespace meshcontour::detail

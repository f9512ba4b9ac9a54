#include "render/layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "meshcontour/parallel.hpp"
#include "model/normals.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::size_t kGrain = 8192;
constexpr Rgba kWhite{255, 255, 255, 255}, kBlack{0, 0, 0, 255};

Rgba face_color(const Drawing& drawing, std::size_t shell, std::size_t patch) {
  const std::size_t number = drawing.first_patch[shell] + patch;
  switch (drawing.options.color_by) {
    case ColorBy::Number:
      return patch_number_color(number);
    case ColorBy::Patch:
      if (drawing.options.shading == Shading::None) return patch_color(number);
      return mixed(patch_color(number), kWhite, 0.25);
    case ColorBy::File:
      if (drawing.options.view != View::Report) {
        Rgba color = drawing.model.shells[shell].patches[patch].color;
        color.alpha = 255;
        return color;
      }
      [[fallthrough]];
    default:
      return drawing.palette.mesh;
  }
}

// Whether the mesh has the colours of its points.
bool by_points(const Drawing& drawing, const Shell& shell) {
  return drawing.options.color_by == ColorBy::File && drawing.options.view != View::Report &&
         !shell.point_colors.empty() && shell.point_colors.size() == shell.points.size();
}

Rgba point_color(const Shell& shell, Index point) {
  const Eigen::Vector4d& color = shell.point_colors[point];
  const auto channel = [&](int i) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(color[i], 0., 1.)));
  };
  return {channel(0), channel(1), channel(2), 255};
}

Vertex lit_vertex(const LocalFrame& frame, const Point& p, const Eigen::Vector3f& normal, const Rgba& color) {
  const Eigen::Vector3f local = frame.local(p);
  const auto fixed = [&](int i) {
    return static_cast<std::int16_t>(std::lround(32767 * std::clamp(normal[i], -1.F, 1.F)));
  };
  return {{local.x(), local.y(), local.z()}, {fixed(0), fixed(1), fixed(2), 0}, color};
}

// From light through yellow and red to dark: a coefficient of the largest size, and ones smaller by powers of
// ten.
Rgba detail_color(double size, double largest) {
  constexpr std::array<Rgba, 5> kScale = {{{247, 247, 250, 255},
                                           {255, 237, 160, 255},
                                           {254, 178, 76, 255},
                                           {227, 60, 40, 255},
                                           {110, 0, 50, 255}}};
  constexpr double kDecades = 4;
  if (!(size > 0) || !(largest > 0)) return kScale.front();
  const double at = std::clamp(1 + std::log10(size / largest) / kDecades, 0.0, 1.0) * (kScale.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), kScale.size() - 2);
  return mixed(kScale[below], kScale[below + 1], at - static_cast<double>(below));
}

// One a point, or nothing where the shell has no coefficients.
std::vector<Rgba> detail_colors(const Shell& shell) {
  std::vector<Rgba> colors;
  if (shell.details.size() != shell.points.size()) return colors;
  const double largest = shell.details.empty() ? 0 : *std::ranges::max_element(shell.details);
  for (const double size : shell.details) colors.push_back(detail_color(size, largest));
  return colors;
}

void fill_triangles(const Drawing& drawing, std::size_t s, const std::vector<Rgba>& colors, Vertex* corners) {
  const Shell& shell = drawing.model.shells[s];
  const auto normals = lighting_normals(shell, drawing.options.threads);
  const bool colored_points = colors.empty() && by_points(drawing, shell);
  for (std::size_t p = 0; p < shell.patches.size(); ++p) {
    const Rgba flat_color = face_color(drawing, s, p);
    const Patch& patch = shell.patches[p];
    parallel_for(
        patch.triangle_count, kGrain, drawing.options.threads, [&](std::size_t begin, std::size_t end) {
          for (std::size_t t = patch.first_triangle + begin; t < patch.first_triangle + end; ++t) {
            for (std::size_t c = 0; c < 3; ++c) {
              const Index v = shell.triangles[t][c];
              const Rgba color = !colors.empty()  ? colors[v]
                                 : colored_points ? point_color(shell, v)
                                                  : flat_color;
              corners[3 * t + c] = lit_vertex(drawing.frames[s], shell.points[v], normals[3 * t + c], color);
            }
          }
        });
  }
}

void add_triangles(const Drawing& drawing, bool by_detail, Scene& scene) {
  for (std::size_t s = 0; s < drawing.model.shells.size(); ++s) {
    const std::size_t triangles = drawing.model.shells[s].triangles.size();
    if (!placed(drawing, s) || triangles == 0) continue;
    Batch batch = make_batch(drawing, Batch::Kind::Triangles, s, 0);
    batch.bias = 0;
    batch.range.first = scene.vertices.size();
    batch.range.count = 3 * triangles;
    scene.vertices.reserve(batch.range.first +
                           2 * batch.range.count);  // lines will follow; pages not used cost nothing
    scene.vertices.resize(batch.range.first + batch.range.count);
    fill_triangles(drawing, s, by_detail ? detail_colors(drawing.model.shells[s]) : std::vector<Rgba>{},
                   scene.vertices.data() + batch.range.first);
    scene.batches.push_back(std::move(batch));
  }
}

void add_mesh(const Drawing& drawing, Scene& scene) {
  add_triangles(drawing, false, scene);
}

void add_detail(const Drawing& drawing, Scene& scene) {
  add_triangles(drawing, true, scene);
}

// An edge of a patch, whichever way it runs there.
struct Edge {
  std::array<Index, 2> ends;
  std::size_t patch;

  Edge(Index from, Index to, std::size_t of_patch)
      : ends{std::min(from, to), std::max(from, to)}, patch(of_patch) {}
  friend auto operator<=>(const Edge&, const Edge&) = default;
};

// Each edge once, of the first patch that has it: lines at one place would show in turns.
void make_unique(std::vector<Edge>& edges) {
  std::ranges::sort(edges);
  const auto same_ends = [](const Edge& a, const Edge& b) { return a.ends == b.ends; };
  edges.erase(std::unique(edges.begin(), edges.end(), same_ends), edges.end());
}

// Lines of the patches' colours, or all of one.
void append_edges(const Drawing& drawing, std::size_t s, const std::vector<Edge>& edges, const Rgba& color,
                  float width, Scene& scene) {
  std::vector<Vertex> vertices;
  vertices.reserve(2 * edges.size());
  const Shell& shell = drawing.model.shells[s];
  for (const Edge& edge : edges) {
    const bool own = patches_have_lines(drawing) && edge.patch < shell.patches.size();
    const Rgba line_color = own ? patch_line_color(drawing, s, edge.patch) : color;
    for (const Index v : edge.ends)
      vertices.push_back(flat_vertex(drawing.frames[s], shell.points[v], line_color));
  }
  append(scene, make_batch(drawing, Batch::Kind::Lines, s, width), vertices);
}

void add_edges(const Drawing& drawing, Scene& scene) {
  for (std::size_t s = 0; s < drawing.boundaries.size(); ++s) {
    if (!placed(drawing, s)) continue;
    const Shell& shell = drawing.model.shells[s];
    const auto& patches = drawing.boundaries[s].patches;
    std::vector<Edge> edges;
    for (std::size_t p = 0; p < patches.size(); ++p) {
      for (const BoundaryEdge& edge : patches[p].edges) edges.emplace_back(edge.from, edge.to, p);
    }
    for (const auto& [from, to] : shell.creases) edges.emplace_back(from, to, patches.size());
    make_unique(edges);
    append_edges(drawing, s, edges, drawing.palette.edges, 1.2F, scene);
  }
}

void add_wireframe(const Drawing& drawing, Scene& scene) {
  for (std::size_t s = 0; s < drawing.model.shells.size(); ++s) {
    if (!placed(drawing, s)) continue;
    const Shell& shell = drawing.model.shells[s];
    std::vector<std::vector<Edge>> by_patch(shell.patches.size());
    parallel_for(by_patch.size(), 16, drawing.options.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p) {
        for (const Triangle& t : shell.patch_triangles(p)) {
          for (std::size_t c = 0; c < 3; ++c) by_patch[p].emplace_back(t[c], t[(c + 1) % 3], p);
        }
        make_unique(by_patch[p]);
      }
    });
    std::vector<Edge> edges;
    for (const auto& part : by_patch) edges.insert(edges.end(), part.begin(), part.end());
    if (patches_have_lines(drawing)) make_unique(edges);
    append_edges(drawing, s, edges, drawing.palette.wireframe, 0.8F, scene);
  }
}

void add_points(const Drawing& drawing, Scene& scene) {
  for (std::size_t s = 0; s < drawing.boundaries.size(); ++s) {
    if (!placed(drawing, s)) continue;
    const Shell& shell = drawing.model.shells[s];
    std::vector<bool> done(shell.points.size(), false);
    std::vector<Vertex> vertices;
    for (const PatchBoundary& patch : drawing.boundaries[s].patches) {
      for (const BoundaryEdge& edge : patch.edges) {
        for (const Index v : {edge.from, edge.to}) {
          if (done[v]) continue;
          done[v] = true;
          vertices.push_back(flat_vertex(drawing.frames[s], shell.points[v], drawing.palette.points));
        }
      }
    }
    append(scene, make_batch(drawing, Batch::Kind::Points, s, 4), vertices);
  }
}

// Lines in the frame of the model.
void add_lines(const Drawing& drawing, std::span<const Polyline> lines, const Rgba& color, float width,
               Scene& scene) {
  const std::size_t frame = drawing.frames.size() - 1;
  std::vector<Vertex> vertices;
  for (const Polyline& line : lines) {
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      for (const std::size_t end : {i, i + 1}) {
        vertices.push_back(flat_vertex(drawing.frames[frame], line.points[end], color));
      }
    }
  }
  append(scene, make_batch(drawing, Batch::Kind::Lines, frame, width), vertices);
}

void add_annotations(const Drawing& drawing, Scene& scene) {
  add_lines(drawing, drawing.model.annotations, drawing.palette.annotations, 1.4F, scene);
}

void add_tree(const Drawing& drawing, Scene& scene) {
  add_lines(drawing, drawing.model.tree, drawing.palette.tree, 1.4F, scene);
}

void add_path(const Drawing& drawing, Scene& scene) {
  add_lines(drawing, drawing.model.path, drawing.palette.path, 2.4F, scene);
}

struct LayerRow {
  Layer layer;
  void (*add)(const Drawing&, Scene&);
};

constexpr std::array<LayerRow, 13> kLayers = {{{Layer::Mesh, add_mesh},
                                               {Layer::Detail, add_detail},
                                               {Layer::Edges, add_edges},
                                               {Layer::Curves, add_curves},
                                               {Layer::Control, add_control},
                                               {Layer::Wireframe, add_wireframe},
                                               {Layer::Points, add_points},
                                               {Layer::Frames, add_frames},
                                               {Layer::Annotations, add_annotations},
                                               {Layer::Tree, add_tree},
                                               {Layer::Path, add_path},
                                               {Layer::Axes, add_axes},
                                               {Layer::Scale, add_scale}}};

}  // namespace

bool placed(const Drawing& drawing, std::size_t frame) {
  return frame < drawing.magnification.size() && drawing.magnification[frame] > 0;
}

Batch make_batch(const Drawing& drawing, Batch::Kind kind, std::size_t frame, float size) {
  Batch batch;
  batch.kind = kind;
  batch.frame = frame;
  batch.size = size * drawing.line_scale;
  batch.bias = drawing.bias;
  return batch;
}

void append(Scene& scene, Batch&& batch, const std::vector<Vertex>& vertices) {
  if (vertices.empty() && batch.runs.empty()) return;
  batch.range.first = scene.vertices.size();
  batch.range.count = vertices.size();
  scene.vertices.insert(scene.vertices.end(), vertices.begin(), vertices.end());
  scene.batches.push_back(std::move(batch));
}

Vertex flat_vertex(const LocalFrame& frame, const Point& p, const Rgba& color) {
  const Eigen::Vector3f local = frame.local(p);
  return {.position = {local.x(), local.y(), local.z()}, .color = color};
}

bool is_legend(Layer layer) {
  return layer == Layer::Axes || layer == Layer::Scale;
}

bool patches_have_lines(const Drawing& drawing) {
  return drawing.options.color_by == ColorBy::Patch || drawing.options.color_by == ColorBy::Number;
}

Rgba patch_line_color(const Drawing& drawing, std::size_t shell, std::size_t patch) {
  const std::size_t number = drawing.first_patch[shell] + patch;
  return drawing.options.color_by == ColorBy::Number ? patch_number_color(number)
                                                     : mixed(patch_color(number), kBlack, 0.4);
}

void add_layer(const Drawing& drawing, Layer layer, Scene& scene) {
  const auto row = std::ranges::find(kLayers, layer, &LayerRow::layer);
  if (row != kLayers.end()) row->add(drawing, scene);
}

}  // namespace meshcontour::detail

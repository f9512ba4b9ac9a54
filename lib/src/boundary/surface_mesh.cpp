#include "meshcontour/surface_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "boundary/edge_filter.hpp"
#include "boundary/halfedge.hpp"
#include "boundary/held_triangles.hpp"
#include "model/adjacency.hpp"

namespace meshcontour {
namespace {

using Vertex = SurfaceMesh::Vertex_index;
using Halfedge = SurfaceMesh::Halfedge_index;
using Face = SurfaceMesh::Face_index;

template <class Key, class Value>
auto add_map(SurfaceMesh& mesh, std::string_view name, const Value& initial = Value()) {
  return mesh.add_property_map<Key, Value>(std::string(name), initial).first;
}

template <class Key, class Value>
auto find_map(const SurfaceMesh& mesh, std::string_view name) {
  return mesh.property_map<Key, Value>(std::string(name));
}

// Links the halfedges of triangles whose neighbours are known. Surface_mesh::add_face would look for the
// neighbours around each vertex, at a cost of the square of its degree, and in CGAL 5.5 it links the
// halfedges at a vertex wrongly when one of several fans closes.
class Builder {
 public:
  Builder(const Shell& shell, const detail::HeldTriangles& held)
      : held_(held), border_out_(held.vertices.size()) {
    const auto faces = static_cast<Face::size_type>(held.triangles.size());
    const auto borders = static_cast<Face::size_type>(std::ranges::count(held.opposite, detail::kNoSide));
    mesh_.reserve(static_cast<Face::size_type>(held.vertices.size()), (3 * faces + borders) / 2, faces);
    add_vertices(shell);
    add_faces();
    link_border();
  }

  SurfaceMesh take() { return std::move(mesh_); }

 private:
  void add_vertices(const Shell& shell) {
    auto index = add_map<Vertex, Index>(mesh_, property::kVertex);
    for (const Index v : held_.vertices) {
      const Point& p = shell.points[v];
      index[mesh_.add_vertex({p.x(), p.y(), p.z()})] = v;
    }
  }

  void add_faces() {
    auto triangle = add_map<Face, std::size_t>(mesh_, property::kTriangle);
    auto flipped = add_map<Face, bool>(mesh_, property::kFlipped, false);
    halfedges_.resize(held_.opposite.size());
    for (std::size_t i = 0; i < held_.triangles.size(); ++i) {
      const Face face = mesh_.add_face();
      triangle[face] = held_.sources[i];
      flipped[face] = held_.flipped[i];
      for (std::size_t k = 0; k < 3; ++k) add_side(3 * i + k, face);
      for (std::size_t k = 0; k < 3; ++k)
        mesh_.set_next(halfedges_[3 * i + k], halfedges_[3 * i + (k + 1) % 3]);
      mesh_.set_halfedge(face, halfedges_[3 * i + 2]);
    }
  }

  void add_side(std::size_t side, Face face) {
    const Triangle& t = held_.triangles[side / 3];
    const Vertex from(t[side % 3]), to(t[(side + 1) % 3]);
    const std::size_t other = held_.opposite[side];
    const bool is_new = other == detail::kNoSide || other > side;
    halfedges_[side] = is_new ? mesh_.add_edge(from, to) : mesh_.opposite(halfedges_[other]);
    mesh_.set_face(halfedges_[side], face);
    mesh_.set_halfedge(to, halfedges_[side]);
    if (other == detail::kNoSide) border_out_[to] = mesh_.opposite(halfedges_[side]);
  }

  // A vertex has one fan, so one border halfedge comes in and one goes out; the one that comes in becomes its
  // own, so that border tests need not walk round.
  void link_border() {
    for (std::size_t side = 0; side < halfedges_.size(); ++side) {
      if (held_.opposite[side] != detail::kNoSide) continue;
      const Halfedge border = mesh_.opposite(halfedges_[side]);
      mesh_.set_face(border, SurfaceMesh::null_face());
      mesh_.set_next(border, border_out_[mesh_.target(border)]);
    }
    mesh_.set_vertex_halfedge_to_border_halfedge();
  }

  const detail::HeldTriangles& held_;
  SurfaceMesh mesh_;
  std::vector<Halfedge> halfedges_;   // of the sides
  std::vector<Halfedge> border_out_;  // of the vertices
};

// The corners of a face as its triangle has them; corner k is at the target of halfedge k.
std::array<Halfedge, 3> corners(const SurfaceMesh& mesh, Face face, bool flipped) {
  const Halfedge a = mesh.halfedge(face), b = mesh.next(a), c = mesh.next(b);
  return flipped ? std::array{a, c, b} : std::array{a, b, c};
}

void decorate(const Shell& shell, SurfaceMesh& mesh) {
  const auto triangle = find_map<Face, std::size_t>(mesh, property::kTriangle).first;
  const auto flipped = find_map<Face, bool>(mesh, property::kFlipped).first;
  auto patch = add_map<Face, std::size_t>(mesh, property::kPatch);
  auto color = add_map<Face, CGAL::IO::Color>(mesh, property::kColor);
  for (const Face face : mesh.faces()) {
    const auto after = std::ranges::upper_bound(shell.patches, triangle[face], {}, &Patch::first_triangle);
    patch[face] = static_cast<std::size_t>(after - shell.patches.begin()) - 1;
    const Rgba& c = shell.patches[patch[face]].color;
    color[face] = CGAL::IO::Color(c.red, c.green, c.blue, c.alpha);
  }
  if (!shell.corner_normals.empty()) {
    auto normal = add_map<Halfedge, Vector>(mesh, property::kNormal, Vector(Vector::Zero()));
    for (const Face face : mesh.faces()) {
      const auto at = corners(mesh, face, flipped[face]);
      for (std::size_t k = 0; k < 3; ++k) normal[at[k]] = shell.corner_normals[3 * triangle[face] + k];
    }
  }
}

HalfedgePatch to_surface_mesh(const Shell& shell, std::size_t first, std::size_t count) {
  detail::ZeroedArray<Index> slots;
  detail::HeldTriangles held = detail::hold_triangles(shell, first, count, slots);
  HalfedgePatch result{Builder(shell, held).take(), held.rejected_as_given, std::move(held.unheld)};
  decorate(shell, result.mesh);
  return result;
}

// Turns a mesh into a shell; every property map may be missing.
class ShellWriter {
 public:
  ShellWriter(const SurfaceMesh& mesh, std::string_view id)
      : mesh_(mesh),
        patch_(find_map<Face, std::size_t>(mesh, property::kPatch)),
        color_(find_map<Face, CGAL::IO::Color>(mesh, property::kColor)),
        flipped_(find_map<Face, bool>(mesh, property::kFlipped)),
        normal_(find_map<Halfedge, Vector>(mesh, property::kNormal)) {
    shell_.id = id;
  }

  Shell run() {
    add_points();
    std::vector<std::pair<std::size_t, Face>> faces;
    for (const Face face : mesh_.faces()) faces.push_back({patch_.second ? patch_.first[face] : 0, face});
    std::ranges::sort(faces);
    for (const auto& [patch, face] : faces) {
      if (mesh_.degree(face) != 3) {
        throw Error(ErrorCode::BadData,
                    fmt::format("mesh {}: a face is not a triangle", printable(shell_.id)));
      }
      while (shell_.patches.size() <= patch) {
        shell_.patches.push_back(
            {fmt::format("{}", shell_.patches.size() + 1), {}, shell_.triangles.size(), 0});
      }
      add_face(face);
    }
    return std::move(shell_);
  }

 private:
  void add_points() {
    number_.resize(mesh_.number_of_vertices() + mesh_.number_of_removed_vertices());
    for (const Vertex v : mesh_.vertices()) {
      number_[v] = static_cast<Index>(shell_.points.size());
      const auto& p = mesh_.point(v);
      shell_.points.emplace_back(p.x(), p.y(), p.z());
    }
  }

  void add_face(Face face) {
    Patch& patch = shell_.patches.back();
    if (color_.second && patch.triangle_count == 0) {
      const CGAL::IO::Color& c = color_.first[face];
      patch.color = {c.red(), c.green(), c.blue(), c.alpha()};
    }
    ++patch.triangle_count;
    const auto at = corners(mesh_, face, flipped_.second && flipped_.first[face]);
    Triangle& triangle = shell_.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = number_[mesh_.target(at[k])];
      if (normal_.second) shell_.corner_normals.push_back(normal_.first[at[k]]);
    }
  }

  template <class Key, class Value>
  using MaybeMap = std::pair<SurfaceMesh::Property_map<Key, Value>, bool>;

  const SurfaceMesh& mesh_;
  MaybeMap<Face, std::size_t> patch_;
  MaybeMap<Face, CGAL::IO::Color> color_;
  MaybeMap<Face, bool> flipped_;
  MaybeMap<Halfedge, Vector> normal_;
  std::vector<Index> number_;
  Shell shell_;
};

// The boundary of a mesh that Builder made.
class BorderWalk {
 public:
  explicit BorderWalk(const SurfaceMesh& mesh)
      : mesh_(mesh),
        index_(find_map<Vertex, Index>(mesh, property::kVertex).first),
        flipped_(find_map<Face, bool>(mesh, property::kFlipped).first),
        visited_(mesh.number_of_halfedges()) {}

  void run(PatchBoundary& boundary) {
    std::vector<BoundaryEdge> edges;
    std::vector<std::pair<BoundaryEdge, BoundaryLoop>> loops;
    for (const Halfedge border : mesh_.halfedges()) {
      const Halfedge start = mesh_.opposite(border);
      if (mesh_.is_border(border) && !visited_[start]) loops.push_back(walk(start, edges));
    }
    std::ranges::sort(edges);
    boundary.edges = std::move(edges);
    std::ranges::sort(loops, {}, [](const auto& loop) { return loop.first; });
    std::vector<BoundaryLoop> sorted;
    for (auto& [edge, loop] : loops) sorted.push_back(std::move(loop));
    boundary.loops = std::move(sorted);
  }

 private:
  // The edge of an inner halfedge on the border, as the triangle runs that it belongs to.
  BoundaryEdge edge(Halfedge h) const {
    const Index from = index_[mesh_.source(h)], to = index_[mesh_.target(h)];
    return flipped_[mesh_.face(h)] ? BoundaryEdge{to, from} : BoundaryEdge{from, to};
  }

  // A loop in canonical form, with its smallest edge; its edges are appended to `edges`.
  std::pair<BoundaryEdge, BoundaryLoop> walk(Halfedge start, std::vector<BoundaryEdge>& edges) {
    std::vector<Halfedge> halfedges;
    for (Halfedge h = start; !visited_[h]; h = mesh_.opposite(mesh_.prev(mesh_.opposite(h)))) {
      visited_[h] = true;
      halfedges.push_back(h);
      edges.push_back(edge(h));
    }
    const auto first = std::ranges::min_element(halfedges, {}, [&](Halfedge h) { return edge(h); });
    std::rotate(halfedges.begin(), first, halfedges.end());
    const bool backwards = flipped_[mesh_.face(halfedges[0])];
    if (backwards) std::ranges::reverse(halfedges.begin() + 1, halfedges.end());
    std::vector<Index> vertices;
    for (const Halfedge h : halfedges) {
      vertices.push_back(index_[backwards ? mesh_.target(h) : mesh_.source(h)]);
    }
    return {edge(halfedges[0]), {std::move(vertices), true}};
  }

  const SurfaceMesh& mesh_;
  SurfaceMesh::Property_map<Vertex, Index> index_;
  SurfaceMesh::Property_map<Face, bool> flipped_;
  std::vector<bool> visited_;
};

void count_vertices(PatchBoundary& boundary) {
  std::vector<Index> ends;
  for (const auto& [from, to] : boundary.edges) ends.insert(ends.end(), {from, to});
  std::ranges::sort(ends);
  for (auto first = ends.begin(); first != ends.end(); ++boundary.vertex_count) {
    const auto last = std::upper_bound(first, ends.end(), *first);
    if (last - first > 2) ++boundary.touching_vertices;
    first = last;
  }
}

}  // namespace

HalfedgePatch to_surface_mesh(const Shell& shell, std::size_t patch) {
  return to_surface_mesh(shell, shell.patches[patch].first_triangle, shell.patches[patch].triangle_count);
}

HalfedgePatch to_surface_mesh(const Shell& shell) {
  return to_surface_mesh(shell, 0, shell.triangles.size());
}

Shell to_shell(const SurfaceMesh& mesh, std::string_view id) {
  return ShellWriter(mesh, id).run();
}

namespace detail {

PatchBoundary halfedge_boundary(const Shell& shell, std::size_t patch, Workspace& workspace) {
  const Patch& range = shell.patches[patch];
  const HeldTriangles held =
      hold_triangles(shell, range.first_triangle, range.triangle_count, workspace.slots);
  const SurfaceMesh mesh = Builder(shell, held).take();
  PatchBoundary boundary;
  BorderWalk(mesh).run(boundary);
  count_vertices(boundary);
  boundary.unheld_triangles = held.unheld.size();
  if (held.rejected_as_given > 0) {
    const EdgeCensus& census = census_of_edges(shell.patch_triangles(patch), shell.points.size(), workspace);
    boundary.nonmanifold_edges = census.nonmanifold;
    boundary.inconsistent_edges = census.inconsistent;
  }
  return boundary;
}

}  // namespace detail
}  // namespace meshcontour

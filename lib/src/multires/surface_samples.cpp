#include "multires/surface_samples.hpp"

#include "meshcontour/parallel.hpp"
#include "multires/triangle_tree.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::size_t kFew = 16;  // samples a triangle of the mesh
constexpr std::size_t kGrain = 1 << 10;

// Barycentric coordinates of the samples inside a triangle: none, the centre, or with a point near each
// corner.
std::vector<Vector> inner_places(std::size_t surface_triangles, std::size_t mesh_triangles) {
  std::vector<Vector> places;
  if (surface_triangles >= 2 * kFew * mesh_triangles) return places;
  places.push_back(Vector::Constant(1.0 / 3));
  if (2 * surface_triangles >= kFew * mesh_triangles) return places;
  for (Eigen::Index k = 0; k < 3; ++k) {
    Vector near = Vector::Constant(1.0 / 6);
    near[k] = 2.0 / 3;
    places.push_back(near);
  }
  return places;
}

// Samples of one patch; `normals` has a zero for each point before and after.
void sample_patch(const Shell& surface, std::size_t patch, const std::vector<Vector>& places,
                  std::vector<Vector>& normals, std::vector<SurfaceSample>& samples) {
  const auto normal_of = [&](const Triangle& t) -> Vector {
    const Point &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
    return (b - a).cross(c - a);
  };
  const double inner_share = places.empty() ? 0 : 3.0 / static_cast<double>(places.size());
  std::vector<Index> vertices;
  for (const Triangle& t : surface.patch_triangles(patch)) {
    const Vector normal = normal_of(t);
    for (const Index v : t) {
      if (normals[v].isZero(0)) vertices.push_back(v);
      normals[v] += normal;
    }
    for (const Vector& at : places) {
      const Point p =
          at[0] * surface.points[t[0]] + at[1] * surface.points[t[1]] + at[2] * surface.points[t[2]];
      samples.push_back({p, normal.stableNormalized(), inner_share * normal.norm(), 0});
    }
  }
  for (const Index v : vertices) {
    if (normals[v].isZero(0)) continue;
    samples.push_back({surface.points[v], normals[v].stableNormalized(), normals[v].norm(), 0});
    normals[v].setZero();
  }
}

}  // namespace

std::vector<SurfaceSample> surface_samples(const Shell& surface, const Shell& mesh, unsigned threads) {
  const std::vector<Vector> places = inner_places(surface.triangles.size(), mesh.triangles.size());
  std::vector<Vector> normals(surface.points.size(), Vector::Zero());
  std::vector<SurfaceSample> samples;
  for (std::size_t p = 0; p < surface.patches.size(); ++p) {
    const std::size_t first = samples.size();
    const auto triangles = mesh.patch_triangles(p);
    if (triangles.empty()) continue;
    sample_patch(surface, p, places, normals, samples);
    const TriangleTree tree(mesh.points, triangles);
    parallel_for(samples.size() - first, kGrain, threads, [&](std::size_t begin, std::size_t end) {
      Index found = 0;
      for (std::size_t s = first + begin; s < first + end; ++s) {
        found = tree.nearest(samples[s].point, found).triangle;
        const auto& [a, b, c] = tree.corners(found);
        if ((b - a).cross(c - a).dot(samples[s].normal) < 0) samples[s].share = -1;
        samples[s].triangle = static_cast<Index>(mesh.patches[p].first_triangle) + found;
      }
    });
  }
  std::erase_if(samples, [](const SurfaceSample& s) { return s.share < 0; });
  return samples;
}

}  // namespace meshcontour::detail

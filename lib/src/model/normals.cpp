#include "model/normals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "meshcontour/parallel.hpp"

namespace meshcontour::detail {
namespace {

using Normal = Eigen::Vector3f;

constexpr std::size_t kGrain = 4096;
constexpr double kCreaseCosine = 0.8191520442889918;  // of 35 degrees
constexpr std::size_t kCompared = 64;                 // corners of a patch at a vertex

// A triangle's shares in the normals of its vertices.
struct Facet {
  Vector normal = Vector::Zero();  // of length 1, or zero for a triangle without area
  std::array<double, 3> angles{};
};

Vector facet_normal(const Shell& shell, const Triangle& t) {
  const Vector ab = shell.points[t[1]] - shell.points[t[0]], ac = shell.points[t[2]] - shell.points[t[0]];
  const double scale = std::max(ab.cwiseAbs().maxCoeff(), ac.cwiseAbs().maxCoeff());
  if (!(scale > 0) || !std::isfinite(scale)) return Vector::Zero();
  const Vector normal = (ab / scale).cross(ac / scale);
  const double length = normal.norm();
  return length > 0 ? Vector(normal / length) : Vector::Zero();
}

double corner_angle(const Shell& shell, const Triangle& t, std::size_t corner) {
  const Point& p = shell.points[t[corner]];
  const Vector a = (shell.points[t[(corner + 1) % 3]] - p).stableNormalized();
  const Vector b = (shell.points[t[(corner + 2) % 3]] - p).stableNormalized();
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// For each vertex the corners (3 * triangle + 0..2) that are there, in order of triangles.
struct Incidence {
  std::vector<std::size_t> first;
  std::vector<std::size_t> corners;

  explicit Incidence(const Shell& shell)
      : first(shell.points.size() + 1, 0), corners(3 * shell.triangles.size()) {
    for (const Triangle& t : shell.triangles) {
      for (const Index v : t) ++first[v + 1];
    }
    for (std::size_t v = 0; v < shell.points.size(); ++v) first[v + 1] += first[v];
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < shell.triangles.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) corners[next[shell.triangles[i][c]]++] = 3 * i + c;
    }
  }
};

// Normals of the corners that one patch has at one vertex.
void smooth(std::span<const std::size_t> corners, const std::vector<Facet>& facets,
            std::vector<Normal>& normals) {
  Vector all = Vector::Zero();
  const auto share = [&](std::size_t c) {
    return Vector(facets[c / 3].angles[c % 3] * facets[c / 3].normal);
  };
  for (const std::size_t c : corners) all += share(c);
  for (const std::size_t c : corners) {
    const Vector& own = facets[c / 3].normal;
    Vector sum = all;
    if (corners.size() <= kCompared) {
      sum.setZero();
      for (const std::size_t other : corners) {
        if (facets[other / 3].normal.dot(own) >= kCreaseCosine) sum += share(other);
      }
    }
    sum.normalize();
    normals[c] = (sum.dot(own) >= kCreaseCosine ? sum : own).cast<float>();
  }
}

std::vector<std::size_t> patch_of_triangles(const Shell& shell) {
  std::vector<std::size_t> patches(shell.triangles.size(), 0);
  for (std::size_t p = 0; p < shell.patches.size(); ++p) {
    const Patch& patch = shell.patches[p];
    std::fill_n(patches.begin() + static_cast<std::ptrdiff_t>(patch.first_triangle), patch.triangle_count, p);
  }
  return patches;
}

std::vector<Facet> make_facets(const Shell& shell, unsigned threads) {
  std::vector<Facet> facets(shell.triangles.size());
  parallel_for(shell.triangles.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      facets[i].normal = facet_normal(shell, shell.triangles[i]);
      for (std::size_t c = 0; c < 3; ++c) facets[i].angles[c] = corner_angle(shell, shell.triangles[i], c);
    }
  });
  return facets;
}

void compute_normals(const Shell& shell, unsigned threads, std::vector<Normal>& normals) {
  const std::vector<Facet> facets = make_facets(shell, threads);
  const Incidence incidence(shell);
  const std::vector<std::size_t> patches = patch_of_triangles(shell);
  parallel_for(shell.points.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      std::size_t from = incidence.first[v];
      while (from < incidence.first[v + 1]) {
        const std::size_t patch = patches[incidence.corners[from] / 3];
        std::size_t to = from + 1;
        while (to < incidence.first[v + 1] && patches[incidence.corners[to] / 3] == patch) ++to;
        smooth(std::span(incidence.corners).subspan(from, to - from), facets, normals);
        from = to;
      }
    }
  });
}

// The file's normals, each triangle's turned to the outside together.
void take_given_normals(const Shell& shell, unsigned threads, std::vector<Normal>& normals) {
  parallel_for(shell.triangles.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vector outside = facet_normal(shell, shell.triangles[i]);
      const Vector* given = &shell.corner_normals[3 * i];
      const double side = outside.dot(given[0]) + outside.dot(given[1]) + outside.dot(given[2]);
      for (std::size_t c = 0; c < 3; ++c) {
        if (!given[c].isZero()) normals[3 * i + c] = (side < 0 ? Vector(-given[c]) : given[c]).cast<float>();
      }
    }
  });
}

}  // namespace

std::vector<Normal> lighting_normals(const Shell& shell, unsigned threads) {
  std::vector<Normal> normals(3 * shell.triangles.size(), Normal::Zero());
  const auto unknown = [](const Vector& normal) { return normal.isZero(); };
  if (shell.corner_normals.empty() || std::ranges::any_of(shell.corner_normals, unknown)) {
    compute_normals(shell, threads, normals);
  }
  if (!shell.corner_normals.empty()) take_given_normals(shell, threads, normals);
  for (Normal& normal : normals) {
    if (normal.isZero()) normal = Normal::UnitZ();
  }
  return normals;
}

}  // namespace meshcontour::detail

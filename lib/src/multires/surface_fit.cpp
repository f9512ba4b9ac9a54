#include "multires/surface_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "meshcontour/parallel.hpp"
#include "multires/block_system.hpp"
#include "multires/level.hpp"
#include "multires/surface_samples.hpp"
#include "multires/triangle_shape.hpp"
#include "multires/triangle_tree.hpp"

namespace meshcontour::detail {
namespace {

constexpr Index kNone = MeshLevel::kNone;
constexpr double kTangentialShare = 0.05;  // of a distance within the surface
constexpr double kPull = 1e-3;             // towards where a vertex is, beside the mean share of a vertex
constexpr double kLeastCosine = 0.5;       // of the turn of a triangle in a step
constexpr double kLeastSupport = 3;        // samples, by their weights at a vertex that moves
constexpr double kLeastShape = 0.08 * std::numbers::sqrt3;  // of a triangle that a flip makes
constexpr double kGain = 0.99;                              // of the error before a flip that may remain
constexpr int kFlipRounds = 4, kMostSteps = 10, kMostAttempts = 50;
constexpr std::size_t kGrain = 1 << 10;

Vector normal_of(const Corners& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]);
}

double shape(const Corners& t) {
  return triangle_shape(t[0], t[1], t[2]);
}

double squared_distance(const Corners& t, const Point& p) {
  return (nearest_point(t, p) - p).squaredNorm();
}

// Barycentric coordinates of a point of a triangle.
Vector weights_at(const Corners& t, const Point& p) {
  const Vector normal = normal_of(t);
  const double area = normal.squaredNorm();
  if (!(area > 0)) return Vector::Constant(1.0 / 3);
  const double u = (t[2] - t[1]).cross(p - t[1]).dot(normal) / area;
  const double v = (t[0] - t[2]).cross(p - t[2]).dot(normal) / area;
  return {u, v, 1 - u - v};
}

bool turns(const Vector& before, const Vector& after) {
  return !(before.dot(after) > kLeastCosine * before.norm() * after.norm());
}

class SurfaceFit {
 public:
  SurfaceFit(Shell& mesh, std::vector<SurfaceSample> samples, unsigned threads)
      : points_(mesh.points), triangles_(mesh.triangles), samples_(std::move(samples)), threads_(threads) {
    MeshLevel level = make_level(mesh);
    for (Index v = 0; v < level.vertex_count; ++v) free_.push_back(level.sharp_edges[v] == 0);
    for (Index h = 0; h < level.twins.size(); ++h) smooth_.push_back(level.across(h));
    twins_ = std::move(level.twins);
    valences_ = std::move(level.valences);
  }

  void run(int rounds) {
    for (int round = 0; round < rounds; ++round) {
      place_samples();
      if (round > 0) flip_edges();
      solve();
    }
    place_samples();
    flip_edges();
  }

 private:
  // Two triangles with a common edge a-b, and what a flip makes of them.
  struct Quad {
    Index a, b, c, d;
    std::array<Corners, 2> before, after;
  };

  Index start(Index h) const { return triangles_[h / 3][h % 3]; }

  Corners corners(Index t) const {
    const auto& [a, b, c] = triangles_[t];
    return {points_[a], points_[b], points_[c]};
  }

  // From where it was each sample walks to the nearest triangle around.
  void place_samples() {
    parallel_for(samples_.size(), kGrain, threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s) walk(samples_[s]);
    });
    first_.assign(triangles_.size(), kNone);
    next_.assign(samples_.size(), kNone);
    for (Index s = 0; s < samples_.size(); ++s) list(s);
  }

  void walk(SurfaceSample& sample) const {
    double best = squared_distance(corners(sample.triangle), sample.point);
    for (int step = 0; step < kMostSteps; ++step) {
      const Index from = sample.triangle;
      for (Index h = 3 * from; h < 3 * from + 3; ++h) {
        if (smooth_[h] == kNone) continue;
        const double squared = squared_distance(corners(smooth_[h] / 3), sample.point);
        if (squared >= best) continue;
        best = squared;
        sample.triangle = smooth_[h] / 3;
      }
      if (sample.triangle == from) return;
    }
  }

  void list(Index s) {
    next_[s] = first_[samples_[s].triangle];
    first_[samples_[s].triangle] = s;
  }

  void flip_edges() {
    for (int round = 0; round < kFlipRounds; ++round) {
      bool flipped = false;
      for (Index h = 0; h < smooth_.size(); ++h) {
        if (smooth_[h] != kNone && h < smooth_[h] && wants_flip(h)) {
          flip(h);
          flipped = true;
        }
      }
      if (!flipped) return;
    }
  }

  Quad quad_at(Index h) const {
    const Index g = twins_[h];
    const Index a = start(h), b = start(g), c = start(MeshLevel::previous(h)),
                d = start(MeshLevel::previous(g));
    const Point &pa = points_[a], &pb = points_[b], &pc = points_[c], &pd = points_[d];
    return {a, b, c, d, {{{pa, pb, pc}, {pb, pa, pd}}}, {{{pa, pd, pc}, {pd, pb, pc}}}};
  }

  bool wants_flip(Index h) const {
    const Quad quad = quad_at(h);
    if (quad.c == quad.d) return false;
    const Vector normal =
        normal_of(quad.before[0]).stableNormalized() + normal_of(quad.before[1]).stableNormalized();
    for (const Corners& t : quad.after) {
      if (turns(normal, normal_of(t))) return false;
    }
    const double shape_after = std::min(shape(quad.after[0]), shape(quad.after[1]));
    if (shape_after < kLeastShape && shape_after < std::min(shape(quad.before[0]), shape(quad.before[1])))
      return false;
    double before = 0, after = 0;
    for (const Index side : {h / 3, twins_[h] / 3}) {
      for (Index s = first_[side]; s != kNone; s = next_[s]) {
        before += samples_[s].share * nearest(quad.before, samples_[s].point).first;
        after += samples_[s].share * nearest(quad.after, samples_[s].point).first;
      }
    }
    return after < kGain * before && !adjacent(h);
  }

  // The squared distance and which of the two is nearer.
  static std::pair<double, std::size_t> nearest(const std::array<Corners, 2>& pair, const Point& p) {
    const double one = squared_distance(pair[0], p), two = squared_distance(pair[1], p);
    return one <= two ? std::pair(one, std::size_t{0}) : std::pair(two, std::size_t{1});
  }

  // Whether the tips on both sides of an edge have an edge already; the one with fewer edges is gone round.
  bool adjacent(Index h) const {
    Index begin = MeshLevel::previous(h), other = MeshLevel::previous(twins_[h]);
    if (valences_[start(other)] < valences_[start(begin)]) std::swap(begin, other);
    const Index tip = start(other);
    const auto has = [&](Index g) {
      return start(MeshLevel::next(g)) == tip || start(MeshLevel::previous(g)) == tip;
    };
    for (Index g = begin; g != kNone;) {
      if (has(g)) return true;
      g = twins_[MeshLevel::previous(g)];
      if (g == begin) return false;
    }
    for (Index g = twins_[begin]; g != kNone; g = twins_[MeshLevel::next(g)]) {
      if (has(MeshLevel::next(g))) return true;
    }
    return false;
  }

  void flip(Index h) {
    const Quad quad = quad_at(h);
    const Index g = twins_[h], t = h / 3, u = g / 3;
    // The sides of the new triangles, as halfedges of the old ones.
    const std::array<Index, 4> old = {MeshLevel::next(g), MeshLevel::previous(h), MeshLevel::previous(g),
                                      MeshLevel::next(h)};
    std::array<Index, 4> twins{}, smooth{};
    for (std::size_t k = 0; k < 4; ++k) {
      twins[k] = twins_[old[k]];
      smooth[k] = smooth_[old[k]];
    }
    for (const Index v : {quad.a, quad.b}) --valences_[v];
    for (const Index v : {quad.c, quad.d}) ++valences_[v];
    triangles_[t] = {quad.a, quad.d, quad.c};
    triangles_[u] = {quad.d, quad.b, quad.c};
    const std::array<Index, 4> places = {3 * t, 3 * t + 2, 3 * u, 3 * u + 1};
    for (std::size_t k = 0; k < 4; ++k) {
      join(twins_, places[k], twins[k]);
      join(smooth_, places[k], smooth[k]);
    }
    join(twins_, 3 * t + 1, 3 * u + 2);
    join(smooth_, 3 * t + 1, 3 * u + 2);
    move_samples(t, u, quad);
  }

  static void join(std::vector<Index>& twins, Index h, Index other) {
    twins[h] = other;
    if (other != kNone) twins[other] = h;
  }

  void move_samples(Index t, Index u, const Quad& quad) {
    Index rest = kNone;
    for (const Index side : {t, u}) {
      for (Index s = first_[side]; s != kNone;) {
        const Index following = next_[s];
        next_[s] = rest;
        rest = s;
        s = following;
      }
      first_[side] = kNone;
    }
    while (rest != kNone) {
      const Index s = rest;
      rest = next_[s];
      samples_[s].triangle = nearest(quad.after, samples_[s].point).second == 0 ? t : u;
      list(s);
    }
  }

  void solve() {
    double all = 0;
    for (const SurfaceSample& sample : samples_) all += sample.share;
    const double pull = kPull * all / static_cast<double>(std::max<std::size_t>(1, points_.size()));
    BlockSystem system(triangles_, free_, pull > 0 ? pull : 1);
    constexpr double kTangential = kTangentialShare * kTangentialShare;
    std::vector<double> support(points_.size(), 0);
    for (const SurfaceSample& sample : samples_) {
      const Corners triangle = corners(sample.triangle);
      const Point foot = nearest_point(triangle, sample.point);
      const Eigen::Matrix3d metric =
          sample.share * (kTangential * Eigen::Matrix3d::Identity() +
                          (1 - kTangential) * sample.normal * sample.normal.transpose());
      const Vector weights = weights_at(triangle, foot);
      for (std::size_t k = 0; k < 3; ++k) {
        support[triangles_[sample.triangle][k]] += weights[static_cast<Eigen::Index>(k)];
      }
      system.add(sample.triangle, weights, metric, sample.point - foot);
    }
    std::vector<Vector> shifts = system.solve();
    // What few samples tell is extrapolated: along the long triangles of a cylinder there are none.
    for (std::size_t v = 0; v < shifts.size(); ++v) {
      if (support[v] < kLeastSupport) shifts[v].setZero();
    }
    move(std::move(shifts));
  }

  // Vertices go where they should; those of triangles that would turn too far stay.
  void move(std::vector<Vector> shifts) {
    std::vector<Point> moved(points_.size());
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
      for (std::size_t v = 0; v < moved.size(); ++v) {
        if (!shifts[v].allFinite()) shifts[v].setZero();
        moved[v] = points_[v] + shifts[v];
      }
      if (hold_turned(moved, shifts)) continue;
      points_ = std::move(moved);
      return;
    }
  }

  // Whether there were triangles that turned too far; their vertices get no shift.
  bool hold_turned(const std::vector<Point>& moved, std::vector<Vector>& shifts) const {
    bool any = false;
    for (Index t = 0; t < triangles_.size(); ++t) {
      const auto& [a, b, c] = triangles_[t];
      if (shifts[a].isZero(0) && shifts[b].isZero(0) && shifts[c].isZero(0)) continue;
      if (!turns(normal_of(corners(t)), normal_of({moved[a], moved[b], moved[c]}))) continue;
      for (const Index v : {a, b, c}) shifts[v].setZero();
      any = true;
    }
    return any;
  }

  std::vector<Point>& points_;
  std::vector<Triangle>& triangles_;
  std::vector<SurfaceSample> samples_;
  unsigned threads_;
  std::vector<bool> free_;               // one a vertex
  std::vector<std::uint32_t> valences_;  // of vertices
  std::vector<Index> twins_;             // of halfedges, kNone at borders
  std::vector<Index> smooth_;            // the same, kNone at sharp edges too
  std::vector<Index> first_, next_;      // the samples of a triangle as a list
};

}  // namespace

void fit_to_surface(Shell& mesh, const Shell& surface, int rounds, unsigned threads) {
  SurfaceFit(mesh, surface_samples(surface, mesh, threads), threads).run(rounds);
}

}  // namespace meshcontour::detail

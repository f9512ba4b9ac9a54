#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "meshcontour/remeshing.hpp"
#include "meshcontour/simplification.hpp"
#include "multires/base_mesh.hpp"
#include "multires/placement.hpp"
#include "multires/relaxation.hpp"
#include "multires/triangle_tree.hpp"
#include "multires/vertex_quadrics.hpp"

namespace meshcontour {
namespace {

using detail::MeshLevel;
using detail::SelfParameterization;

constexpr std::size_t kGrowth = 4;            // of the triangles, to resolve those of the surface
constexpr std::size_t kMostGrowth = 8;        // where patches keep the base mesh from becoming smaller
constexpr std::size_t kMostSmallGrowth = 16;  // of small ones
constexpr std::size_t kSmall = 1 << 20;       // triangles
constexpr unsigned kLeastLevels = 2, kMostLevels = 8;
constexpr int kSmoothings = 3;         // more make coefficients smaller and the distance larger
constexpr int kUnfoldings = 20;        // rounds
constexpr int kAttempts = 6;           // at a mesh without triangles that are turned over, near enough
constexpr int kMostStuck = 2;          // attempts without much progress
constexpr double kProgress = 0.9;      // beside the attempt before
constexpr double kMostFlipped = 1e-4;  // of the triangles: no further attempt
constexpr double kNearEnough = 0.7;    // of the tolerance
constexpr double kTolerance = 5e-3;    // of the size

// The shell's, creases sharp too; where there is none, a message that helps.
MeshLevel surface_level(const Shell& shell) {
  if (shell.triangles.empty())
    throw Error(ErrorCode::BadData, fmt::format("shell {}: no triangles to remesh", printable(shell.id)));
  try {
    MeshLevel level = detail::make_level(shell);
    for (std::size_t e = 0; e < level.edge_count(); ++e) {
      const auto [low, high] =
          std::minmax({level.start(level.first_halfedge[e]), level.end(level.first_halfedge[e])});
      if (std::ranges::binary_search(shell.creases, std::array<Index, 2>{low, high})) level.sharp[e] = 1;
    }
    return level;
  } catch (const Error& error) {
    throw Error(ErrorCode::BadData, fmt::format("shell {}: {}, which remeshing needs; --repair makes it one",
                                                printable(shell.id), error.what()));
  }
}

// Subdivisions after which a base mesh has no more than so many triangles, one at least.
unsigned levels_within(std::size_t base, std::size_t triangles, unsigned most) {
  unsigned levels = 1;
  while (levels < most && base << (2 * (levels + 1)) <= triangles) ++levels;
  return levels;
}

struct Base {
  SelfParameterization surface;
  unsigned levels = 0;
};

// With as many levels as the number of triangles asks for, or fewer where patches need a finer base mesh.
Base make_base(const Shell& shell, const RemeshOptions& options, const std::vector<bool>& kept) {
  const std::size_t count = shell.triangles.size(),
                    room = std::max(kMostGrowth * count, std::min(kMostSmallGrowth * count, kSmall));
  const unsigned most = options.most_levels;
  unsigned levels =
      std::min(most, std::max(kLeastLevels, levels_within(options.base_triangles, kGrowth * count, most)));
  for (;;) {
    Base base{SelfParameterization(shell, std::uint32_t{1} << levels, kept, options.threads), levels};
    detail::coarsen(base.surface, detail::box_centre(shell), (kGrowth * count) >> (2 * levels));
    const std::size_t left = base.surface.mesh().triangle_count();
    if (levels == 1 || left << (2 * levels) <= room) return base;
    levels = levels_within(left, room, levels - 1);
  }
}

// What points carry, at places between them.
template <class Value>
std::vector<Value> read_at(const std::vector<SurfacePlace>& places, const Shell& shell,
                           const std::vector<Value>& values) {
  std::vector<Value> out;
  if (values.empty()) return out;
  out.reserve(places.size());
  for (const auto& [t, weights] : places) {
    const auto [a, b, c] = shell.triangles[t];
    out.push_back(weights[0] * values[a] + weights[1] * values[b] + weights[2] * values[c]);
  }
  return out;
}

class Remesher {
 public:
  Remesher(const Shell& shell, const RemeshOptions& options)
      : shell_(shell),
        options_(options),
        level_(surface_level(shell)),
        walk_(shell, level_),
        kept_(shell.points.size(), false),
        tolerance_(options.tolerance > 0 ? options.tolerance
                                         : kTolerance * bounding_box(shell).diagonal().norm()) {}

  Remesh run() {
    std::optional<Remesh> best;
    int stuck = 0;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      Remesh result = cover();
      const bool flipped = is_flipped(result), far = result.error > tolerance_;
      const std::vector<bool> kept = kept_;
      if (flipped || far) keep_flipped(result);
      if (far) keep_far(result);
      // Less is turned over, or the same is and it is nearer.
      const auto rank = [&](const Remesh& r) { return std::pair{is_flipped(r) ? r.flipped : 0, r.error}; };
      const bool better = !best || rank(result) < rank(*best);
      stuck += !better || (best && !much_better(result, *best));
      if (better) best = std::move(result);
      if (stuck == kMostStuck || kept == kept_) break;
    }
    return *std::move(best);
  }

 private:
  static bool much_better(const Remesh& result, const Remesh& before) {
    return static_cast<double>(result.flipped) < kProgress * static_cast<double>(before.flipped) ||
           result.error < kProgress * before.error;
  }

  static bool is_flipped(const Remesh& result) {
    return static_cast<double>(result.flipped) >
           kMostFlipped * static_cast<double>(result.shell.triangles.size());
  }

  Remesh cover() {
    const Base made = make_base(shell_, options_, kept_);
    Remesh out;
    out.connectivity.levels = made.levels;
    Shell& base = out.connectivity.base;
    base = made.surface.mesh().to_shell(shell_);
    base.corner_normals.clear();
    base.creases.clear();
    const MeshLevel coarsest = detail::make_level(base);
    MeshLevel finest = coarsest;
    for (unsigned level = 0; level < made.levels; ++level) finest = detail::quadrisected(finest);
    const detail::Placement placement(shell_, made.surface, coarsest, made.levels);
    out.shell = base;
    out.shell.triangles = finest.triangles;
    for (Patch& patch : out.shell.patches) {
      patch.first_triangle <<= 2 * made.levels;
      patch.triangle_count <<= 2 * made.levels;
    }
    detail::Relaxation relaxation(out.shell, finest, shell_, walk_,
                                  placement.vertices(finest, options_.threads));
    const std::vector<bool> kept = kept_triangles(base.triangles.size());
    for (int i = 0; i < kSmoothings; ++i) relaxation.smooth(coarsest.vertex_count, kept);
    for (int i = 0; i < kUnfoldings && relaxation.unfold() > 0; ++i) {
    }
    flipped_ = relaxation.flipped();
    out.flipped = flipped_.size();
    out.places = relaxation.places();
    fill(out);
    return out;
  }

  // All where nothing was collapsed.
  std::vector<bool> kept_triangles(std::size_t base_triangles) const {
    std::vector<bool> kept(shell_.triangles.size());
    for (std::size_t t = 0; t < kept.size(); ++t) {
      const auto [a, b, c] = shell_.triangles[t];
      kept[t] = base_triangles == kept.size() || (kept_[a] && kept_[b] && kept_[c]);
    }
    return kept;
  }

  // What became a base triangle with triangles turned over stays as it is in the next attempt.
  void keep_flipped(const Remesh& result) {
    const std::size_t children = std::size_t{1} << (2 * result.connectivity.levels);
    for (const Index t : flipped_) {
      const std::size_t first = t / children * children;
      for (std::size_t child = first; child < first + children; ++child) {
        for (const Index v : result.shell.triangles[child]) keep_triangle(result.places[v].triangle);
      }
    }
  }

  // So does what is too far from the other surface.
  void keep_far(const Remesh& result) {
    const Shell& fine = result.shell;
    for (std::size_t p = 0; p < shell_.patches.size(); ++p) {
      const detail::TriangleTree before(shell_.points, shell_.patch_triangles(p)),
          after(fine.points, fine.patch_triangles(p));
      for (const Triangle& t : shell_.patch_triangles(p)) {
        if (!is_far(shell_, t, after)) continue;
        for (const Index v : t) kept_[v] = true;
      }
      for (const Triangle& t : fine.patch_triangles(p)) {
        if (!is_far(fine, t, before)) continue;
        for (const Index v : t) keep_triangle(result.places[v].triangle);
      }
    }
  }

  // In its corners, in the middles of its sides or in its own.
  bool is_far(const Shell& shell, const Triangle& t, const detail::TriangleTree& other) const {
    const Point &a = shell.points[t[0]], &b = shell.points[t[1]], &c = shell.points[t[2]];
    const double most = kNearEnough * tolerance_;
    const std::array<Point, 7> samples = {a, b, c, (a + b) / 2, (b + c) / 2, (c + a) / 2, (a + b + c) / 3};
    return std::ranges::any_of(samples,
                               [&](const Point& p) { return other.nearest(p).squared > most * most; });
  }

  void keep_triangle(Index t) {
    for (const Index v : shell_.triangles[t]) kept_[v] = true;
  }

  void fill(Remesh& out) const {
    out.shell.points = read_at(out.places, shell_, shell_.points);
    out.shell.point_colors = read_at(out.places, shell_, shell_.point_colors);
    out.shell.texture_coordinates = read_at(out.places, shell_, shell_.texture_coordinates);
    out.connectivity.order.resize(out.places.size());
    std::iota(out.connectivity.order.begin(), out.connectivity.order.end(), Index{0});
    out.error = patch_distance(shell_, out.shell, options_.threads).upper;
  }

  const Shell& shell_;
  const RemeshOptions& options_;
  MeshLevel level_;
  detail::SurfaceWalk walk_;
  std::vector<bool> kept_;  // points that no attempt may remove
  double tolerance_;
  std::vector<Index> flipped_;  // triangles of the last attempt
};

}  // namespace

Remesh remeshed(const Shell& shell, const RemeshOptions& options) {
  if (options.most_levels < 1 || options.most_levels > kMostLevels || options.base_triangles < 1 ||
      !(options.tolerance >= 0)) {
    throw Error(ErrorCode::Usage, fmt::format("remeshing: expected 1 to {} levels, a triangle or more and a "
                                              "tolerance of 0 or more",
                                              kMostLevels));
  }
  return Remesher(shell, options).run();
}

}  // namespace meshcontour

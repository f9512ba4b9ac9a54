#include "multires/placement.hpp"

#include <algorithm>
#include <cmath>

#include "meshcontour/parallel.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::size_t kGrain = 1024;

using Weights = std::array<double, 3>;

Weights between(const Weights& a, const Weights& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

// A list of equal steps read in between.
double interpolated(const std::vector<double>& values, double share) {
  const double at = share * static_cast<double>(values.size() - 1);
  const auto step = std::min(static_cast<std::size_t>(at), values.size() - 2);
  const double rest = at - static_cast<double>(step);
  return (1 - rest) * values[step] + rest * values[step + 1];
}

}  // namespace

Placement::Placement(const Shell& shell, const SelfParameterization& surface, const MeshLevel& base,
                     unsigned levels)
    : shell_(shell), surface_(surface), base_(base), levels_(levels), corner_of_(shell.points.size()) {
  for (Index h = 0; h < surface.mesh().halfedge_count(); ++h) {
    corner_of_[shell.triangles[h / 3][h % 3]] = h;
    if (h % 3 == 0 && surface.mesh().is_alive(h)) slots_.push_back(h / 3);
  }
  sharp_edges_ = surface.sharp_edges();
  find_curves();
}

void Placement::find_curves() {
  curves_.resize(base_.edge_count());
  for (Index e = 0; e < base_.edge_count(); ++e) {
    const Index h = base_.first_halfedge[e], on_surface = 3 * slots_[h / 3] + h % 3;
    if (!surface_.mesh().is_sharp(on_surface)) continue;
    curves_[e].vertices = surface_.curve(on_surface);
    std::vector<double> lengths;
    for (std::size_t i = 1; i < curves_[e].vertices.size(); ++i) {
      const Index u = curves_[e].vertices[i - 1], v = curves_[e].vertices[i];
      lengths.push_back((surface_.mesh().point(v) - surface_.mesh().point(u)).norm());
    }
    curves_[e].split = split_curve(lengths, levels_);
  }
}

Placement::Side Placement::side(Index triangle, std::size_t k) const {
  const Index h = 3 * triangle + static_cast<Index>(k), e = base_.edges[h];
  return {curves_[e].vertices.empty() ? nullptr : &curves_[e], base_.first_halfedge[e] == h};
}

// Of a triangle of the finest level, on its base triangle.
std::array<Placement::Weights, 3> Placement::corners(Index triangle) const {
  std::array<Weights, 3> at = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (unsigned level = levels_; level-- > 0;) {
    const Weights p = between(at[0], at[1]), q = between(at[1], at[2]), r = between(at[2], at[0]);
    switch (triangle >> (2 * level) & 3) {
      case 0:
        at = {at[0], p, r};
        break;
      case 1:
        at = {p, at[1], q};
        break;
      case 2:
        at = {r, q, at[2]};
        break;
      default:
        at = {p, q, r};
    }
  }
  return at;
}

std::vector<SurfacePlace> Placement::vertices(const MeshLevel& finest, unsigned threads) const {
  std::vector<SurfacePlace> places(finest.vertex_count);
  std::vector<bool> known(finest.vertex_count, false);
  for (Index f = 0; f < finest.triangles.size(); ++f) {
    const std::array<Weights, 3> at = corners(f);
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = finest.triangles[f][k];
      if (!known[v]) places[v] = {f >> (2 * levels_), at[k]};
      known[v] = true;
    }
  }
  parallel_for(places.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      places[v] = v < base_.vertex_count ? at_vertex(static_cast<Index>(v)) : on_surface(places[v]);
    }
  });
  return places;
}

SurfacePlace Placement::middle(Index triangle) const {
  const std::array<Weights, 3> at = corners(triangle);
  Weights mean{};
  for (std::size_t k = 0; k < 3; ++k) mean[k] = (at[0][k] + at[1][k] + at[2][k]) / 3;
  return inside({triangle >> (2 * levels_), mean});
}

// Vertices of the base mesh are where they were.
SurfacePlace Placement::at_vertex(Index v) const {
  const Index h = base_.outgoing[v], on_surface = 3 * slots_[h / 3] + h % 3;
  const Index corner = corner_of_[surface_.mesh().origin(surface_.mesh().start(on_surface))];
  SurfacePlace place{corner / 3, {}};
  place.weights[corner % 3] = 1;
  return place;
}

SurfacePlace Placement::on_surface(const SurfacePlace& place) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const Side line = side(place.triangle, k);
    if (line.curve != nullptr && place.weights[(k + 2) % 3] == 0)
      return on_curve(line, place.weights[(k + 1) % 3]);
  }
  return inside(place);
}

SurfacePlace Placement::on_curve(const Side& side, double share) const {
  const std::vector<double>& places = side.curve->split.places;
  const auto last = static_cast<double>(places.size() - 1);
  const double at = places[static_cast<std::size_t>(std::lround(last * (side.forward ? share : 1 - share)))];
  const auto edge = std::min(static_cast<std::size_t>(at), side.curve->vertices.size() - 2);
  const Index u = side.curve->vertices[edge], v = side.curve->vertices[edge + 1];
  const std::array<Index, 2> ends = {std::min(u, v), std::max(u, v)};
  const auto found = std::ranges::lower_bound(sharp_edges_, SharpEdge{ends, 0});
  SurfacePlace place{found->second / 3, {}};
  const Triangle& triangle = shell_.triangles[place.triangle];
  const double rest = at - static_cast<double>(edge);
  for (std::size_t k = 0; k < 3; ++k) {
    if (triangle[k] == surface_.mesh().origin(u)) place.weights[k] = 1 - rest;
    if (triangle[k] == surface_.mesh().origin(v)) place.weights[k] = rest;
  }
  return place;
}

// Between curves places move as these do, along lines from their sharp side to the corner across, which keeps
// the other sides as they are.
SurfacePlace Placement::inside(const SurfacePlace& place) const {
  Weights weights = place.weights;
  for (std::size_t k = 0; k < 3; ++k) {
    const Side line = side(place.triangle, k);
    const std::size_t end = (k + 1) % 3;
    const double both = weights[k] + weights[end];
    if (line.curve == nullptr || !(both > 0)) continue;
    const double share = weights[end] / both;
    const std::vector<double>& shares = line.curve->split.shares;
    const double moved = line.forward ? interpolated(shares, share) : 1 - interpolated(shares, 1 - share);
    weights[k] = both * (1 - moved);
    weights[end] = both * moved;
  }
  return surface_.origin({slots_[place.triangle], weights});
}

}  // namespace meshcontour::detail

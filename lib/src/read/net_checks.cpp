#include "read/net_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "model/adjacency.hpp"

namespace meshcontour::detail {
namespace {

using Fail = std::function<void(std::size_t, const std::string&)>;

// Calls visit(face, corners) for every face.
template <typename Visit>
void for_each_face(const NetFaces& faces, Visit&& visit) {
  std::span<const Index> rest = faces.polygons.corners;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    visit(f, rest.first(faces.polygons.sizes[f]));
    rest = rest.subspan(faces.polygons.sizes[f]);
  }
}

// The face that a triangle was cut from.
std::size_t face_of(const NetFaces& faces, std::size_t triangle) {
  std::size_t face = 0;
  for (std::size_t next = 0; face < faces.size(); ++face) {
    next += faces.polygons.sizes[face] - 2;
    if (triangle < next) break;
  }
  return face;
}

void check_corners(const NetFaces& faces, const Fail& fail) {
  for_each_face(faces, [&](std::size_t f, std::span<const Index> corners) {
    for (auto corner = corners.begin(); corner != corners.end(); ++corner) {
      if (std::find(corners.begin(), corner, *corner) != corner)
        fail(f, fmt::format("corner {} is repeated", *corner));
    }
  });
}

// The same corners in the same cycle, either way round, give the same list.
std::vector<Index> canonical(std::span<const Index> corners) {
  std::vector<Index> cycle(corners.begin(), corners.end());
  std::rotate(cycle.begin(), std::ranges::min_element(cycle), cycle.end());
  if (cycle[1] > cycle.back()) std::reverse(cycle.begin() + 1, cycle.end());
  return cycle;
}

// Equal faces have equal sums of mixed corners; few others do.
void check_equal_faces(const NetFaces& faces, const Fail& fail) {
  std::vector<std::pair<std::uint64_t, std::size_t>> sums;
  std::vector<std::span<const Index>> places;
  sums.reserve(faces.size());
  places.reserve(faces.size());
  for_each_face(faces, [&](std::size_t f, std::span<const Index> corners) {
    std::uint64_t sum = 0;
    for (std::uint64_t mixed : corners) {
      mixed = (mixed + 1) * 0x9e3779b97f4a7c15u;
      sum += (mixed ^ (mixed >> 29)) * 0xbf58476d1ce4e5b9u;
    }
    sums.push_back({sum, f});
    places.push_back(corners);
  });
  std::ranges::sort(sums);
  for (std::size_t first = 0, i = 1; i < sums.size(); ++i) {
    if (sums[i].first != sums[first].first) first = i;
    const std::size_t f = sums[i].second, before = sums[i - 1].second;
    if (i > first && canonical(places[f]) == canonical(places[before])) {
      fail(f, fmt::format("the same face as number {}", before + 1));
    }
  }
}

void check_edges(const NetFaces& faces, std::span<const Triangle> triangles, const Adjacency& adjacency,
                 const Fail& fail) {
  for (Index side = 0; side < adjacency.opposite.size(); ++side) {
    const Index other = adjacency.opposite[side];
    const Index from = side_start(triangles, side), to = side_end(triangles, side);
    if (other == kManySides) {
      fail(face_of(faces, triangle_of(side)),
           fmt::format("the edge {} {} has three or more faces", from, to));
    }
    if (is_paired(other) && side_start(triangles, other) == from) {
      fail(face_of(faces, triangle_of(side)),
           fmt::format("two faces run along the edge {} {} the same way", from, to));
    }
  }
}

// The triangles round a point of an oriented surface.
struct Fan {
  Index triangles = 1;
  bool closed = false;
};

// Sides that start at the point follow one another round it.
Fan walk_fan(const Adjacency& adjacency, Index start) {
  Fan fan;
  for (Index side = start; adjacency.opposite[previous_side(side)] != kNoSide; ++fan.triangles) {
    side = adjacency.opposite[previous_side(side)];
    if (side == start) return {fan.triangles, true};
  }
  for (Index side = start; adjacency.opposite[side] != kNoSide; ++fan.triangles) {
    side = next_side(adjacency.opposite[side]);
  }
  return fan;
}

void check_points(const NetFaces& faces, std::span<const Triangle> triangles, std::size_t points,
                  const Adjacency& adjacency, bool strict, const Fail& fail) {
  std::vector<Index> uses(points, 0), corner(points, 0);
  for (Index side = 0; side < adjacency.opposite.size(); ++side) {
    corner[side_start(triangles, side)] = side;
    ++uses[side_start(triangles, side)];
  }
  for (std::size_t v = 0; v < points; ++v) {
    const auto refuse = [&](const std::string& why) { fail(face_of(faces, triangle_of(corner[v])), why); };
    if (uses[v] == 0 && strict) fail(faces.size(), fmt::format("no face uses the point {}", v));
    if (uses[v] == 0) continue;
    const Fan fan = walk_fan(adjacency, corner[v]);
    if (fan.triangles != uses[v]) refuse(fmt::format("at the point {} faces only touch (bow tie)", v));
    const std::size_t edges = fan.triangles + (fan.closed ? 0 : 1);
    if (strict && (edges < 3 || edges > 16))
      refuse(fmt::format("the point {} has {} edges, not 3 to 16", v, edges));
  }
}

}  // namespace

void check_net(const NetFaces& faces, std::span<const Triangle> triangles, std::size_t points,
               const ReadOptions& options, const Fail& fail) {
  check_corners(faces, fail);
  check_equal_faces(faces, fail);
  if (options.net.mend) return;
  const Adjacency adjacency = side_adjacency(triangles, points, options.threads);
  check_edges(faces, triangles, adjacency, fail);
  check_points(faces, triangles, points, adjacency, options.net.strict, fail);
}

std::vector<std::size_t> folded_faces(const NetFaces& faces, std::span<const Point> points) {
  std::vector<std::size_t> folded;
  std::vector<Vector> areas;
  for_each_face(faces, [&](std::size_t f, std::span<const Index> corners) {
    if (corners.size() == 3) return;
    areas.clear();
    Vector sum = Vector::Zero();
    const Point& first = points[corners[0]];
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
      areas.push_back((points[corners[i]] - first).cross(points[corners[i + 1]] - first));
      sum += areas.back();
    }
    if (std::ranges::any_of(areas, [&](const Vector& area) { return area.dot(sum) < 0; }))
      folded.push_back(f);
  });
  return folded;
}

}  // namespace meshcontour::detail

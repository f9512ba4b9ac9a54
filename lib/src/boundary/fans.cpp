#include "boundary/fans.hpp"

#include <algorithm>
#include <limits>

#include "boundary/edge_filter.hpp"

namespace meshcontour::detail {
namespace {

using End = std::size_t;  // 2 * edge: where it leaves its first vertex; 2 * edge + 1: where it arrives

constexpr End kOpen = std::numeric_limits<End>::max();

struct VertexEnd {
  Index vertex;
  End end;
};

// A side of a triangle at a vertex: the neighbour it leads to.
struct Spoke {
  Index neighbour;
  std::size_t corner;
};

struct Corner {
  std::size_t group;  // which crowded vertex
  Index left, right;
};

// Pairs the ends that meet at each vertex.
class EndPairing {
 public:
  EndPairing(std::span<const Triangle> triangles, std::span<const BoundaryEdge> edges,
             std::size_t vertex_bound, ZeroedArray<Index>& slots)
      : edges_(edges), mates_(2 * edges.size(), kOpen) {
    sort_ends();
    pair_at_plain_vertices();
    if (crowded_.empty()) return;
    collect_corners(triangles, vertex_bound, slots);
    for (std::size_t i = 0, first = 0; i < crowded_.size(); ++i) {
      std::size_t last = first;
      while (last < corners_.size() && corners_[last].group == i) ++last;
      pair_by_fans(crowded_[i], std::span(corners_).subspan(first, last - first));
      first = last;
    }
  }

  End mate(End end) const { return mates_[end]; }
  std::size_t vertices() const { return vertices_; }
  std::size_t crowded_vertices() const { return crowded_.size(); }

 private:
  using Group = std::span<const VertexEnd>;

  void sort_ends() {
    ends_.reserve(2 * edges_.size());
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      ends_.push_back({edges_[i].from, 2 * i});
      ends_.push_back({edges_[i].to, 2 * i + 1});
    }
    std::ranges::sort(ends_, [](const VertexEnd& a, const VertexEnd& b) {
      return a.vertex != b.vertex ? a.vertex < b.vertex : a.end < b.end;
    });
  }

  void pair_at_plain_vertices() {
    for (std::size_t first = 0; first < ends_.size(); ++vertices_) {
      std::size_t last = first + 1;
      while (last < ends_.size() && ends_[last].vertex == ends_[first].vertex) ++last;
      if (last - first == 2) join(ends_[first].end, ends_[first + 1].end);
      if (last - first > 2) crowded_.push_back(Group(ends_).subspan(first, last - first));
      first = last;
    }
  }

  void collect_corners(std::span<const Triangle> triangles, std::size_t vertex_bound,
                       ZeroedArray<Index>& slots) {
    slots.reserve(vertex_bound);
    for (std::size_t i = 0; i < crowded_.size(); ++i) slots[crowded_[i][0].vertex] = static_cast<Index>(i);
    for (const Triangle& t : triangles) {
      if (degenerate(t)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = slots[t[k]];
        if (i >= crowded_.size() || crowded_[i][0].vertex != t[k]) continue;
        corners_.push_back({i, t[(k + 1) % 3], t[(k + 2) % 3]});
      }
    }
    std::ranges::stable_sort(corners_, {}, &Corner::group);
  }

  Index neighbour(End end) const { return end % 2 == 0 ? edges_[end / 2].to : edges_[end / 2].from; }

  void pair_by_fans(Group group, std::span<const Corner> corners) {
    std::vector<Spoke> spokes;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      spokes.push_back({corners[i].left, i});
      spokes.push_back({corners[i].right, i});
    }
    std::ranges::sort(spokes, [](const Spoke& a, const Spoke& b) {
      return a.neighbour != b.neighbour ? a.neighbour < b.neighbour : a.corner < b.corner;
    });
    std::vector<std::pair<Index, End>> by_neighbour;
    for (const VertexEnd& e : group) by_neighbour.push_back({neighbour(e.end), e.end});
    std::ranges::sort(by_neighbour);

    std::vector<std::pair<Index, End>> stopped;
    for (const auto& [from, end] : by_neighbour) {
      if (mates_[end] != kOpen) continue;
      const Index stop = walk_fan(from, corners, spokes);
      const auto other = std::ranges::lower_bound(by_neighbour, stop, {}, &std::pair<Index, End>::first);
      if (stop != from && other != by_neighbour.end() && other->first == stop) {
        join(end, other->second);
      } else {
        stopped.push_back({stop, end});
      }
    }
    pair_stopped(std::move(stopped));
  }

  // From a boundary spoke across triangles to the next spoke that does not have just two of them.
  static Index walk_fan(Index spoke, std::span<const Corner> corners, std::span<const Spoke> spokes) {
    const auto at = [&](Index v) {
      const auto first = std::ranges::lower_bound(spokes, v, {}, &Spoke::neighbour);
      return std::span(first, std::ranges::upper_bound(first, spokes.end(), v, {}, &Spoke::neighbour));
    };
    auto here = at(spoke);
    if (here.size() != 1) return spoke;
    for (std::size_t corner = here[0].corner;;) {
      spoke = corners[corner].left == spoke ? corners[corner].right : corners[corner].left;
      here = at(spoke);
      if (here.size() != 2) return spoke;
      corner = here[0].corner == corner ? here[1].corner : here[0].corner;
    }
  }

  // Ends whose fans stop at a crowded edge: first those that stop at the same one.
  void pair_stopped(std::vector<std::pair<Index, End>> stopped) {
    std::ranges::sort(stopped);
    std::vector<End> rest;
    for (std::size_t first = 0; first < stopped.size();) {
      std::vector<End> together;
      std::size_t last = first;
      for (; last < stopped.size() && stopped[last].first == stopped[first].first; ++last) {
        together.push_back(stopped[last].second);
      }
      std::ranges::copy(join_opposite(together), std::back_inserter(rest));
      first = last;
    }
    std::ranges::sort(rest);
    rest = join_opposite(rest);
    for (std::size_t i = 0; i + 1 < rest.size(); i += 2) join(rest[i], rest[i + 1]);
  }

  // Joins arriving to leaving ends, in order; returns those left over, which all arrive or all leave.
  std::vector<End> join_opposite(std::span<const End> ends) {
    std::vector<End> leaving, arriving;
    for (const End end : ends) (end % 2 == 0 ? leaving : arriving).push_back(end);
    const std::size_t pairs = std::min(leaving.size(), arriving.size());
    for (std::size_t i = 0; i < pairs; ++i) join(leaving[i], arriving[i]);
    std::vector<End>& longer = leaving.size() > pairs ? leaving : arriving;
    longer.erase(longer.begin(), longer.begin() + static_cast<std::ptrdiff_t>(pairs));
    return longer;
  }

  void join(End a, End b) {
    mates_[a] = b;
    mates_[b] = a;
  }

  std::span<const BoundaryEdge> edges_;
  std::vector<End> mates_;
  std::vector<VertexEnd> ends_;
  std::vector<Group> crowded_;  // vertices with more than two ends
  std::vector<Corner> corners_;
  std::size_t vertices_ = 0;
};

// Where to start so that edge i is run forwards: at its loop's own start, or at the open end behind it.
End loop_start(std::size_t i, const EndPairing& pairing) {
  End end = 2 * i;
  for (;;) {
    const End before = pairing.mate(end);
    if (before == kOpen) return end;
    if (before / 2 == i) return 2 * i;
    end = before ^ 1;
  }
}

BoundaryLoop walk(End start, std::span<const BoundaryEdge> edges, const EndPairing& pairing,
                  std::vector<bool>& visited) {
  std::vector<Index> vertices;
  for (End end = start;;) {
    const BoundaryEdge& edge = edges[end / 2];
    visited[end / 2] = true;
    vertices.push_back(end % 2 == 0 ? edge.from : edge.to);
    const End next = pairing.mate(end ^ 1);
    if (next == start) return {std::move(vertices), true};
    if (next == kOpen) {
      vertices.push_back(end % 2 == 0 ? edge.to : edge.from);
      return {std::move(vertices), false};
    }
    end = next;
  }
}

}  // namespace

LoopTrace trace_paired(std::span<const Triangle> triangles, std::span<const BoundaryEdge> edges,
                       std::size_t vertex_bound, Workspace& workspace) {
  const EndPairing pairing(triangles, edges, vertex_bound, workspace.slots);
  LoopTrace trace{{}, pairing.vertices(), pairing.crowded_vertices()};
  std::vector<bool> visited(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!visited[i]) trace.loops.push_back(walk(loop_start(i, pairing), edges, pairing, visited));
  }
  return trace;
}

}  // namespace meshcontour::detail

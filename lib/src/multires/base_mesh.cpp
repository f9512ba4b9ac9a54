#include "multires/base_mesh.hpp"

#include <algorithm>
#include <queue>

#include "multires/vertex_quadrics.hpp"

namespace meshcontour::detail {
namespace {

using Kind = CollapseMesh::Kind;

constexpr double kLengthWeight = 1e-3;  // of a squared way along the surface beside one away from it

class Coarsener {
 public:
  Coarsener(SelfParameterization& surface, const Point& centre)
      : surface_(surface),
        mesh_(surface.mesh()),
        centre_(centre),
        quadrics_(vertex_quadrics(mesh_, centre)),
        versions_(mesh_.vertex_count(), 0),
        removed_(mesh_.vertex_count(), false) {
    for (Index v = 0; v < mesh_.vertex_count(); ++v) push(v);
  }

  void run(std::size_t triangles) {
    while (!queue_.empty() && mesh_.triangle_count() > triangles) {
      const Candidate candidate = queue_.top();
      queue_.pop();
      if (!removed_[candidate.vertex] && candidate.version == versions_[candidate.vertex])
        remove(candidate.vertex);
    }
  }

 private:
  struct Candidate {
    double cost = 0;
    Index vertex = 0;
    std::uint32_t version = 0;

    // The queue's top is the cheapest, of several the first vertex.
    bool operator<(const Candidate& other) const {
      return cost > other.cost || (cost == other.cost && vertex > other.vertex);
    }
  };
  using Way = std::pair<double, Index>;  // cost, neighbour

  // Where a vertex may go, the cheapest way first.
  void find_ways(Index v) {
    ways_.clear();
    mesh_.outgoing(v, ring_);
    const auto add = [&](Index h, Index w) {
      if (mesh_.kind(v) != Kind::Smooth && !mesh_.is_sharp(h)) return;
      Quadric sum = quadrics_[v];
      sum += quadrics_[w];
      const double length = (mesh_.point(v) - mesh_.point(w)).squaredNorm();
      ways_.emplace_back(sum(mesh_.point(w) - centre_) + kLengthWeight * length * sum.weight, w);
    };
    for (const Index h : ring_) add(h, mesh_.end(h));
    const Index last = CollapseMesh::previous(ring_.back());
    if (mesh_.twin(last) == CollapseMesh::kNone) add(last, mesh_.start(last));
    std::ranges::sort(ways_);
  }

  // What the queue holds of the vertex is out of date.
  void push(Index v) {
    ++versions_[v];
    if (mesh_.kind(v) == Kind::Fixed || mesh_.valence(v) > SelfParameterization::kMostEdges) return;
    find_ways(v);
    if (!ways_.empty()) queue_.push({ways_.front().first, v, versions_[v]});
  }

  void remove(Index v) {
    find_ways(v);
    for (const auto& [cost, kept] : ways_) {
      if (!surface_.remove(v, kept)) continue;
      removed_[v] = true;
      quadrics_[kept] += quadrics_[v];
      mesh_.outgoing(kept, around_);
      const Index last = CollapseMesh::previous(around_.back());
      const bool border = mesh_.twin(last) == CollapseMesh::kNone;
      for (Index& h : around_) h = mesh_.end(h);
      if (border) around_.push_back(mesh_.start(last));
      around_.push_back(kept);
      for (const Index w : around_) push(w);
      return;
    }
  }

  SelfParameterization& surface_;
  const CollapseMesh& mesh_;
  Point centre_;
  std::vector<Quadric> quadrics_;        // of each vertex, relative to centre_
  std::vector<std::uint32_t> versions_;  // of each vertex: older candidates are out of date
  std::vector<bool> removed_;
  std::priority_queue<Candidate> queue_;
  std::vector<Way> ways_;
  std::vector<Index> ring_, around_;
};

}  // namespace

void coarsen(SelfParameterization& surface, const Point& centre, std::size_t triangles) {
  Coarsener(surface, centre).run(triangles);
}

}  // namespace meshcontour::detail

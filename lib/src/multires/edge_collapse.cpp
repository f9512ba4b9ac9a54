#include "multires/edge_collapse.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "multires/collapse_mesh.hpp"
#include "multires/vertex_quadrics.hpp"

namespace meshcontour::detail {
namespace {

using Kind = CollapseMesh::Kind;

constexpr double kLengthWeight = 1e-9;    // decides where the error does not, in planes
constexpr double kLeastCosine = 0.2;      // of the turn of a triangle
constexpr std::uint32_t kMostEdges = 64;  // at a vertex that a collapse leaves

class Collapser {
 public:
  Collapser(const Shell& shell, double limit, unsigned threads, bool keep_sharp)
      : mesh_(shell, threads),
        limit_(limit),
        keep_sharp_(keep_sharp),
        centre_(box_centre(shell)),
        quadrics_(vertex_quadrics(mesh_, centre_)),
        versions_(mesh_.halfedge_count(), 0) {
    for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
      if (is_first(h)) push(h);
    }
  }

  void run(std::size_t triangles) {
    while (!queue_.empty() && mesh_.triangle_count() > triangles) {
      const Candidate candidate = queue_.top();
      queue_.pop();
      if (mesh_.is_alive(candidate.halfedge) && candidate.version == versions_[candidate.halfedge]) {
        collapse(candidate);
      }
    }
  }

  const CollapseMesh& mesh() const { return mesh_; }

 private:
  struct Candidate {
    double cost = 0;
    Index halfedge = 0;
    std::uint32_t version = 0;
    Index removed = 0;
    Point position = Point::Zero();  // relative to centre_

    // The queue's top is the cheapest, of several the first edge.
    bool operator<(const Candidate& other) const {
      return cost > other.cost || (cost == other.cost && halfedge > other.halfedge);
    }
  };

  Point local(Index v) const { return mesh_.point(v) - centre_; }

  // Of the two halfedges of an edge the one that stands for it.
  bool is_first(Index h) const { return mesh_.twin(h) == CollapseMesh::kNone || h < mesh_.twin(h); }

  // What the queue holds of the edge is out of date.
  void push(Index h) {
    ++versions_[h];
    if (mesh_.twin(h) != CollapseMesh::kNone) ++versions_[mesh_.twin(h)];
    const Index u = mesh_.start(h), v = mesh_.end(h);
    const Kind ku = mesh_.kind(u), kv = mesh_.kind(v);
    if (ku == Kind::Fixed && kv == Kind::Fixed) return;
    if (ku != Kind::Smooth && kv != Kind::Smooth && (keep_sharp_ || !mesh_.is_sharp(h))) return;
    Quadric sum = quadrics_[u];
    sum += quadrics_[v];
    const Point a = local(u), b = local(v);
    Candidate candidate{0, h, versions_[h], u, b};
    if (ku == Kind::Smooth && kv == Kind::Smooth) {
      candidate.position = best_inside(sum, a, b);
    } else if (ku > kv || (ku == kv && sum(a) < sum(b))) {
      candidate.removed = v;
      candidate.position = a;
    }
    const double cost = sum(candidate.position);
    if (cost > limit_ * limit_ * sum.weight) return;
    candidate.cost = cost + kLengthWeight * (a - b).squaredNorm() * sum.weight;
    queue_.push(candidate);
  }

  static Point best_inside(const Quadric& sum, const Point& a, const Point& b) {
    const Point middle = (a + b) / 2, best = sum.minimum_near(middle);
    if ((best - middle).norm() <= 2 * (a - b).norm()) return best;
    const Point nearer = sum(a) < sum(b) ? a : b;
    return sum(nearer) < sum(middle) ? nearer : middle;
  }

  // Whether no triangle that stays turns too far when `v` moves.
  bool keeps_sides(Index v, Index other, const Point& position) {
    mesh_.outgoing(v, ring_);
    for (const Index h : ring_) {
      const Index p = mesh_.end(h), q = mesh_.start(CollapseMesh::previous(h));
      if (p == other || q == other) continue;
      const Point at_p = local(p), at_q = local(q);
      const Vector before = (at_p - local(v)).cross(at_q - local(v)),
                   after = (at_p - position).cross(at_q - position);
      if (before.squaredNorm() > 0 && !(before.dot(after) > kLeastCosine * before.norm() * after.norm()))
        return false;
    }
    return true;
  }

  void collapse(const Candidate& candidate) {
    const Index h = candidate.halfedge, removed = candidate.removed;
    const Index kept = mesh_.start(h) == removed ? mesh_.end(h) : mesh_.start(h);
    if (mesh_.valence(removed) + mesh_.valence(kept) > kMostEdges + 4) return;
    if (!mesh_.keeps_topology(h) || !keeps_sides(removed, kept, candidate.position)) return;
    const bool moves = candidate.position != local(kept);
    if (moves && !keeps_sides(kept, removed, candidate.position)) return;
    // A vertex that stays keeps its coordinates to the last bit.
    mesh_.collapse(h, removed, moves ? Point(candidate.position + centre_) : mesh_.point(kept));
    quadrics_[kept] += quadrics_[removed];
    mesh_.outgoing(kept, ring_);
    for (const Index out : ring_) {
      const Index in = CollapseMesh::previous(out);
      for (const Index edge : {out, in}) {
        if (is_first(edge)) push(edge);
      }
    }
  }

  CollapseMesh mesh_;
  double limit_;
  bool keep_sharp_;
  Point centre_;
  std::vector<Quadric> quadrics_;        // of each vertex, relative to centre_
  std::vector<std::uint32_t> versions_;  // of each halfedge: older candidates are out of date
  std::priority_queue<Candidate> queue_;
  std::vector<Index> ring_;
};

}  // namespace

Shell collapsed(const Shell& shell, std::size_t triangles, double limit, unsigned threads, bool keep_sharp) {
  Collapser collapser(shell, limit, threads, keep_sharp);
  collapser.run(triangles);
  return collapser.mesh().to_shell(shell);
}

}  // namespace meshcontour::detail

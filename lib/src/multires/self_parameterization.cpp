#include "multires/self_parameterization.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "multires/triangle_shape.hpp"

namespace meshcontour::detail {
namespace {

using Kind = CollapseMesh::Kind;
using PlanePoint = ChartSequence::PlanePoint;

constexpr Index kNone = CollapseMesh::kNone;
constexpr double kLeastCosine = 0.2;      // of the turn of a triangle
constexpr double kLeastShape = 0.05;      // of a triangle that is no better than one that was there
constexpr double kLeastPlaneShape = 0.2;  // of a triangle in the plane, as a share of its shape in space
constexpr double kLeastTurnCosine = 0.6;  // of the turn of a curve that is straightened there
constexpr double kMostSector = 0.9 * std::numbers::pi;  // between sharp edges that share a triangle
constexpr double kRounding = 1e-12;                     // of such a shape

double shape_of(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  const PlanePoint x = b - a, y = c - a;
  return triangle_shape(x.x() * y.y() - x.y() * y.x(),
                        x.squaredNorm() + (c - b).squaredNorm() + y.squaredNorm());
}

Vector normal_of(const Point& a, const Point& b, const Point& c) {
  return (b - a).cross(c - a);
}

// Whether a triangle keeps its side; one without an area had none.
bool keeps_side(const Vector& before, const Vector& after) {
  return after.squaredNorm() > 0 &&
         (!(before.squaredNorm() > 0) || before.dot(after) > kLeastCosine * before.norm() * after.norm());
}

double angle_between(const Vector& a, const Vector& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

SelfParameterization::SelfParameterization(const Shell& shell, std::uint32_t most_segments,
                                           std::vector<bool> kept, unsigned threads)
    : mesh_(shell, threads),
      charts_(shell.triangles.size()),
      most_segments_(most_segments),
      kept_(std::move(kept)),
      along_(mesh_.vertex_count(), {kNone, kNone}),
      chains_(mesh_.halfedge_count()) {
  const auto note = [&](Index v, Index neighbour) {
    if (along_[v][0] == neighbour) return;
    (along_[v][0] == kNone ? along_[v][0] : along_[v][1]) = neighbour;
  };
  for (Index h = 0; h < chains_.size(); ++h) {
    if (!mesh_.is_sharp(h)) continue;
    const Index u = mesh_.start(h), v = mesh_.end(h);
    chains_[h] = {v, 1, (mesh_.point(v) - mesh_.point(u)).norm(), sector(h)};
    note(u, v);
    note(v, u);
    sharp_edges_.push_back({{std::min(u, v), std::max(u, v)}, h});
  }
  std::ranges::sort(sharp_edges_);
}

double SelfParameterization::sector(Index h) const {
  const Point& at = mesh_.point(mesh_.start(h));
  double angle = 0;
  for (Index g = h; g != kNone;) {
    const Index last = CollapseMesh::previous(g);
    angle += angle_between(mesh_.point(mesh_.end(g)) - at, mesh_.point(mesh_.start(last)) - at);
    g = mesh_.is_sharp(last) ? kNone : mesh_.twin(last);
    if (g == h) break;
  }
  return angle;
}

std::vector<Index> SelfParameterization::curve(Index h) const {
  std::vector<Index> vertices = {mesh_.start(h)};
  Index at = chains_[h].first;
  for (std::uint32_t i = 1; i < chains_[h].segments; ++i) {
    const Index behind = vertices.back();
    vertices.push_back(at);
    at = along_[at][0] == behind ? along_[at][1] : along_[at][0];
  }
  vertices.push_back(mesh_.end(h));
  return vertices;
}

bool SelfParameterization::remove(Index v, Index kept) {
  if (mesh_.kind(v) == Kind::Fixed || kept_[mesh_.origin(v)] || !gather(v, kept)) return false;
  const bool curve = mesh_.kind(v) == Kind::Curve;
  if (mesh_.valence(v) + mesh_.valence(kept) > kMostEdges + 4) return false;
  if (curve) {
    if (!is_sharp(ring_.kept)) return false;
    if (chain_to(ring_.kept).segments + chain_to(ring_.other).segments > most_segments_) return false;
    if (!bends_little()) return false;
    if (!clear_ears() || !gather(v, kept)) return false;
  }
  const Index h = halfedge_to(ring_.kept);
  if (!mesh_.keeps_topology(h) || !keeps_shape(v, kept)) return false;
  if (!keeps_sectors(h) || (mesh_.twin(h) != kNone && !keeps_sectors(mesh_.twin(h)))) return false;
  if (!lay_out(curve) || !stays_unfolded()) return false;
  record();
  join_chains(h);
  if (mesh_.twin(h) != kNone) join_chains(mesh_.twin(h));
  if (curve) extend_chain(v);
  mesh_.collapse(h, v, mesh_.point(kept));
  return true;
}

// False if the two are no neighbours. A closed ring begins at `kept`.
bool SelfParameterization::gather(Index v, Index kept) {
  mesh_.outgoing(v, ring_.out);
  ring_.vertices.clear();
  for (const Index h : ring_.out) ring_.vertices.push_back(mesh_.end(h));
  const Index last = CollapseMesh::previous(ring_.out.back());
  const bool closed = mesh_.twin(last) != kNone;
  if (!closed) ring_.vertices.push_back(mesh_.start(last));
  const auto found = std::ranges::find(ring_.vertices, kept);
  if (found == ring_.vertices.end()) return false;
  ring_.kept = static_cast<std::size_t>(found - ring_.vertices.begin());
  if (closed) {
    const auto first = ring_.out.begin() + static_cast<std::ptrdiff_t>(ring_.kept);
    std::rotate(ring_.out.begin(), first, ring_.out.end());
    std::rotate(ring_.vertices.begin(), found, ring_.vertices.end());
    ring_.kept = 0;
  }
  ring_.other = ring_.kept;
  for (std::size_t i = 0; i < ring_.vertices.size(); ++i) {
    if (i != ring_.kept && is_sharp(i)) ring_.other = i;
  }
  return true;
}

Index SelfParameterization::halfedge_to(std::size_t place) const {
  return place < ring_.out.size() ? ring_.out[place] : CollapseMesh::previous(ring_.out.back());
}

const SelfParameterization::Chain& SelfParameterization::chain_to(std::size_t place) const {
  return chains_[halfedge_to(place)];
}

// On each side of a curve two triangles at least, as one would become nothing.
bool SelfParameterization::clear_ears() {
  const std::size_t first = std::min(ring_.kept, ring_.other), second = std::max(ring_.kept, ring_.other);
  const bool one = second - first == 1, two = ring_.is_closed() && ring_.out.size() - second + first == 1;
  const Index before = one ? CollapseMesh::next(ring_.out[first]) : kNone,
              behind = two ? CollapseMesh::next(ring_.out[second]) : kNone;
  return (before == kNone || flip(before)) && (behind == kNone || flip(behind));
}

// Corners and tight arcs stay, unless they stand between single edges of the beginning.
bool SelfParameterization::bends_little() const {
  if (chain_to(ring_.kept).segments == 1 && chain_to(ring_.other).segments == 1) return true;
  const Point& at = mesh_.point(mesh_.start(ring_.out.front()));
  const Vector a = at - mesh_.point(ring_.vertices[ring_.other]),
               b = mesh_.point(ring_.vertices[ring_.kept]) - at;
  return a.dot(b) >= kLeastTurnCosine * a.norm() * b.norm();
}

// Where the two sides of a dying triangle become one sharp edge, the triangle beside it may come to lie
// between two of them: it covers less than half a turn, and so must what is between them in the beginning.
bool SelfParameterization::keeps_sectors(Index h) const {
  const Index a = CollapseMesh::next(h), b = CollapseMesh::previous(h);
  if (mesh_.is_sharp(a) == mesh_.is_sharp(b)) return true;
  const bool from_tip = mesh_.is_sharp(b);
  const Index beside = mesh_.twin(from_tip ? a : b), after = CollapseMesh::next(beside),
              before = CollapseMesh::previous(beside);
  return from_tip ? fits_between(b, before) && fits_between(after, h)
                  : fits_between(after, a) && fits_between(h, before);
}

// Whether one triangle may lie between two edges around a vertex, the first of which leaves it.
bool SelfParameterization::fits_between(Index first, Index second) const {
  return !mesh_.is_sharp(first) || !mesh_.is_sharp(second) || chains_[first].sector < kMostSector;
}

bool SelfParameterization::flip(Index h) {
  if (kept_[mesh_.origin(mesh_.start(h))] && kept_[mesh_.origin(mesh_.end(h))]) return false;
  if (!mesh_.can_flip(h)) return false;
  const Index g = mesh_.twin(h), after_h = CollapseMesh::next(h), after_g = CollapseMesh::next(g),
              before_h = CollapseMesh::previous(h), before_g = CollapseMesh::previous(g);
  if (!fits_between(after_g, before_h) || !fits_between(after_h, before_g)) return false;
  const Point &u = mesh_.point(mesh_.start(h)), &v = mesh_.point(mesh_.end(h)),
              &tip = mesh_.point(mesh_.end(after_h)), &across = mesh_.point(mesh_.end(after_g));
  for (const Vector& before : {normal_of(u, v, tip), normal_of(v, u, across)}) {
    if (!keeps_side(before, normal_of(u, across, tip)) || !keeps_side(before, normal_of(across, v, tip)))
      return false;
  }
  const Vector edge = v - u;
  const double length = edge.norm();
  if (!(length > 0)) return false;
  const auto unfolded = [&](const Point& p, double side) {
    return PlanePoint(edge.dot(p - u) / length, side * edge.cross(p - u).norm() / length);
  };
  const std::array<PlanePoint, 4> plane = {PlanePoint(0, 0), unfolded(across, -1), PlanePoint(length, 0),
                                           unfolded(tip, 1)};
  if (shape_of(plane[0], plane[1], plane[3]) < kLeastPlaneShape * triangle_shape(u, across, tip) ||
      shape_of(plane[1], plane[2], plane[3]) < kLeastPlaneShape * triangle_shape(across, v, tip))
    return false;
  const auto face = [](Index halfedge, std::uint8_t a, std::uint8_t b, std::uint8_t c) {
    ChartSequence::Face out{halfedge / 3, {}};
    for (const auto& [k, corner] : {std::pair{0U, a}, {1U, b}, {2U, c}})
      out.corners[(halfedge + k) % 3] = corner;
    return out;
  };
  charts_.add(plane, std::array{face(h, 0, 2, 3), face(g, 2, 0, 1)},
              std::array{face(h, 0, 1, 3), face(g, 1, 2, 3)});
  const Chain to_tip = chains_[after_h];
  chains_[h] = chains_[after_g];
  chains_[g] = chains_[before_g];
  chains_[after_g] = to_tip;
  mesh_.flip(h);
  return true;
}

// Angles around the vertex stretched to a whole turn, or to half a turn on each side of a curve.
bool SelfParameterization::lay_out(bool curve) {
  const Point& centre = mesh_.point(mesh_.start(ring_.out.front()));
  const std::size_t count = ring_.vertices.size(), triangles = ring_.out.size();
  angles_.assign(triangles + 1, 0);
  for (std::size_t i = 0; i < triangles; ++i) {
    const Vector a = mesh_.point(ring_.vertices[i]) - centre,
                 b = mesh_.point(ring_.vertices[(i + 1) % count]) - centre;
    angles_[i + 1] = angles_[i] + angle_between(a, b);
  }
  const std::size_t middle = curve && ring_.is_closed() ? ring_.other : triangles;
  const double first = angles_[middle], second = angles_.back() - first;
  if (!(first > 0) || (middle < triangles && !(second > 0))) return false;
  const double turn = curve ? std::numbers::pi : 2 * std::numbers::pi, power = curve ? 1 : turn / first;
  double longest = 0;
  for (const Index w : ring_.vertices) longest = std::max(longest, (mesh_.point(w) - centre).norm());
  plane_.assign(1, PlanePoint::Zero());
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = i <= middle ? turn * angles_[i] / first : turn * (1 + (angles_[i] - first) / second);
    const double radius = std::pow((mesh_.point(ring_.vertices[i]) - centre).norm() / longest, power);
    if (!(radius > 0)) return false;
    plane_.push_back(radius * PlanePoint(std::cos(angle), std::sin(angle)));
  }
  if (curve) turn_to_lines();
  return true;
}

// The two sharp edges become the parts of a straight line that their lengths ask for.
void SelfParameterization::turn_to_lines() {
  const bool from_kept = ring_.kept < ring_.other;
  const std::size_t right = from_kept ? ring_.kept : ring_.other, left = from_kept ? ring_.other : ring_.kept;
  const double scale_right = chain_to(right).length / plane_[right + 1].norm(),
               scale_left = chain_to(left).length / plane_[left + 1].norm();
  plane_[right + 1].y() = plane_[left + 1].y() = 0;
  for (PlanePoint& p : plane_) {
    p.x() *= p.x() > 0 ? scale_right : scale_left;
    p.y() *= (scale_right + scale_left) / 2;
  }
}

// Whether the triangles before and after all run counter-clockwise in the plane.
bool SelfParameterization::stays_unfolded() const {
  const std::size_t count = ring_.vertices.size();
  const PlanePoint& kept = plane_[ring_.kept + 1];
  for (std::size_t i = 0; i < ring_.out.size(); ++i) {
    const std::size_t j = (i + 1) % count;
    const PlanePoint &p = plane_[i + 1], &q = plane_[j + 1];
    if (shape_of(plane_[0], p, q) < -kRounding) return false;
    if (i == ring_.kept || j == ring_.kept) continue;
    const double in_space = triangle_shape(mesh_.point(ring_.vertices[ring_.kept]),
                                           mesh_.point(ring_.vertices[i]), mesh_.point(ring_.vertices[j]));
    if (!(shape_of(kept, p, q) > kLeastPlaneShape * in_space)) return false;
  }
  return true;
}

bool SelfParameterization::keeps_shape(Index v, Index kept) const {
  const Point &from = mesh_.point(v), &to = mesh_.point(kept);
  double least_before = kLeastShape, least_after = 1;
  for (const Index h : ring_.out) {
    const Index i = mesh_.end(h), j = mesh_.start(CollapseMesh::previous(h));
    const Point &p = mesh_.point(i), &q = mesh_.point(j);
    least_before = std::min(least_before, triangle_shape(from, p, q));
    if (i == kept || j == kept) continue;
    if (!keeps_side(normal_of(from, p, q), normal_of(to, p, q))) return false;
    least_after = std::min(least_after, triangle_shape(to, p, q));
  }
  return least_after >= least_before / 2;
}

void SelfParameterization::record() {
  before_.clear();
  after_.clear();
  const std::size_t count = ring_.vertices.size();
  for (std::size_t i = 0; i < ring_.out.size(); ++i) {
    const Index h = ring_.out[i];
    const std::size_t j = (i + 1) % count;
    ChartSequence::Face face{h / 3, {}};
    face.corners[h % 3] = 0;
    face.corners[(h + 1) % 3] = static_cast<std::uint8_t>(i + 1);
    face.corners[(h + 2) % 3] = static_cast<std::uint8_t>(j + 1);
    before_.push_back(face);
    if (i == ring_.kept || j == ring_.kept) continue;
    face.corners[h % 3] = static_cast<std::uint8_t>(ring_.kept + 1);
    after_.push_back(face);
  }
  charts_.add(plane_, before_, after_);
}

// Where one of two edges that become one is sharp, the halfedge that stays takes its chain.
void SelfParameterization::join_chains(Index h) {
  const Index a = CollapseMesh::next(h), b = CollapseMesh::previous(h), outer_a = mesh_.twin(a),
              outer_b = mesh_.twin(b);
  if (mesh_.is_sharp(a) && outer_b != kNone) chains_[outer_b] = chains_[a];
  if (mesh_.is_sharp(b) && outer_a != kNone) chains_[outer_a] = chains_[b];
}

// The other sharp edge of a vertex that goes becomes longer by the one along which it goes.
void SelfParameterization::extend_chain(Index v) {
  const Index along = halfedge_to(ring_.kept), longer = halfedge_to(ring_.other);
  const Chain added = chains_[along];
  for (const Index h : {longer, mesh_.twin(longer)}) {
    if (h == kNone) continue;
    chains_[h].segments += added.segments;
    chains_[h].length += added.length;
    if (mesh_.start(h) != v) continue;
    // It begins where the halfedge that ran to v begins.
    const Chain& before = chains_[mesh_.end(along) == v ? along : mesh_.twin(along)];
    chains_[h].first = before.first;
    chains_[h].sector = before.sector;
  }
}

}  // namespace meshcontour::detail

#include "fit/chain_contours.hpp"

#include <algorithm>
#include <limits>

#include "fit/certificate.hpp"
#include "fit/cleaning.hpp"
#include "fit/ellipse_fit.hpp"
#include "fit/model_recognition.hpp"
#include "meshcontour/parallel.hpp"

namespace meshcontour::detail {

namespace {

constexpr Index kNoEdge = std::numeric_limits<Index>::max();

// A piece of a chain in the shell's frame, in the chain's direction.
struct PlacedPiece {
  std::size_t from = 0, to = 0;  // vertices of the chain
  Curve curve;
  double deviation = 0;
};

void move_to(Curve& curve, const Point& origin, const Point& start, const Point& end) {
  if (auto* spline = std::get_if<BSplineCurve>(&curve)) {
    for (Point& p : spline->control_points) p += origin;
    if (spline->periodic) return;
    spline->control_points.front() = start;
    spline->control_points.back() = end;
    return;
  }
  std::visit(
      [&](auto& c) {
        if constexpr (requires { c.center; }) c.center += origin;
        if constexpr (requires { c.start; }) {
          c.start = start;
          c.end = end;
        }
      },
      curve);
}

bool is_full(const Curve& curve) {
  if (const auto* arc = std::get_if<CircularArc>(&curve)) return arc->full();
  if (const auto* ellipse = std::get_if<EllipticalArc>(&curve)) return ellipse->full();
  return false;
}

// The products of a certificate lose a few digits of the largest coordinate; the bound must not.
double with_rounding(double deviation, const Point& origin, double extent) {
  return deviation > 0 ? deviation + 1e-15 * (origin.cwiseAbs().maxCoeff() + extent) : deviation;
}

double deviation_of(const Path& path, const Piece& piece) {
  const bool full = is_full(piece.curve);
  const std::span<const Point> points = path.run(piece.begin, full ? piece.end - 1 : piece.end);
  double deviation = piece.deviation;
  if (const auto* line = std::get_if<LineSegment>(&piece.curve)) deviation = line_deviation(*line, points);
  if (const auto* arc = std::get_if<CircularArc>(&piece.curve)) deviation = arc_deviation(*arc, points);
  if (const auto* arc = std::get_if<EllipticalArc>(&piece.curve)) {
    deviation = ellipse_deviation(*arc, points, piece.residual);
  }
  return with_rounding(deviation + path.dropped, path.origin, path.extent);
}

PlacedPiece placed(const Shell& shell, const EdgeChain& chain, const Recognition& fit, const Piece& piece) {
  PlacedPiece result{fit.path.source[piece.begin], fit.path.source[piece.end], piece.curve, 0};
  result.deviation = deviation_of(fit.path, piece);
  const Point& origin = fit.path.origin;
  if (is_full(piece.curve)) {
    std::visit(
        [&](auto& c) {
          if constexpr (requires { c.angle; }) {
            c.center += origin;
            c.start += origin;
            c.end = c.start;
          }
        },
        result.curve);
  } else {
    move_to(result.curve, origin, shell.points[chain.vertices[result.from]],
            shell.points[chain.vertices[result.to]]);
  }
  return result;
}

// The loops of one shell become contours.
class ShellContours {
 public:
  ShellContours(std::size_t number, const Shell& shell, const ShellBoundary& boundary,
                const ShellRecognition& recognition)
      : number_(number), shell_(shell), boundary_(boundary), recognition_(recognition) {
    first_edge_.assign(recognition.fits.size(), kNoEdge);
    place_pieces();
    number_edges();
  }

  std::vector<Contour> contours() const {
    std::vector<Contour> result;
    auto conic = recognition_.conics.begin();
    for (std::size_t p = 0; p < boundary_.patches.size(); ++p) {
      for (std::size_t l = 0; l < boundary_.patches[p].loops.size(); ++l) {
        const bool closed_conic = conic != recognition_.conics.end() && conic->patch == p && conic->loop == l;
        const bool merged = closed_conic && consecutive(recognition_.chains.uses[p][l]);
        result.push_back(merged ? conic_contour(*conic) : loop_contour(p, l));
        if (closed_conic) ++conic;
      }
    }
    return result;
  }

 private:
  void place_pieces() {
    pieces_.resize(recognition_.fits.size());
    for (std::size_t c = 0; c < pieces_.size(); ++c) {
      const Recognition& fit = recognition_.fits[c];
      for (const Piece& piece : fit.pieces) {
        pieces_[c].push_back(placed(shell_, recognition_.chains.chains[c], fit, piece));
      }
    }
  }

  // Loops that are one conic come first, so that their edges follow one another.
  void number_edges() {
    Index next = 0;
    const auto number = [&](const std::vector<ChainUse>& uses) {
      for (const ChainUse& use : uses) {
        if (first_edge_[use.chain] != kNoEdge) continue;
        first_edge_[use.chain] = next;
        next += static_cast<Index>(pieces_[use.chain].size());
      }
    };
    for (const ClosedConic& conic : recognition_.conics)
      number(recognition_.chains.uses[conic.patch][conic.loop]);
    for (const auto& loops : recognition_.chains.uses) {
      for (const std::vector<ChainUse>& uses : loops) number(uses);
    }
  }

  // Whether the edges of these chains are one range of numbers.
  bool consecutive(const std::vector<ChainUse>& uses) const {
    const auto [first, count] = edge_range(uses);
    Index sum = 0;
    for (const ChainUse& use : uses) sum += static_cast<Index>(pieces_[use.chain].size());
    return sum == count;
  }

  std::pair<Index, Index> edge_range(const std::vector<ChainUse>& uses) const {
    Index first = kNoEdge, last = 0;
    for (const ChainUse& use : uses) {
      first = std::min(first, first_edge_[use.chain]);
      last = std::max(last, first_edge_[use.chain] + static_cast<Index>(pieces_[use.chain].size()));
    }
    return {first, last - first};
  }

  Contour conic_contour(const ClosedConic& conic) const {
    const BoundaryLoop& loop = boundary_.patches[conic.patch].loops[conic.loop];
    Contour contour{number_, conic.patch, conic.loop, true, {}, 0, false};
    Segment segment;
    segment.from = segment.to = loop.vertices[0];
    segment.curve = conic.curve;
    std::vector<Point> points;
    for (const Index v : loop.vertices) points.push_back(shell_.points[v]);
    const auto* arc = std::get_if<CircularArc>(&conic.curve);
    segment.deviation = arc ? arc_deviation(*arc, points)
                            : ellipse_deviation(std::get<EllipticalArc>(conic.curve), points, conic.residual);
    segment.deviation = with_rounding(segment.deviation, points[0], box_diagonal(points));
    std::tie(segment.edge, segment.edge_count) =
        edge_range(recognition_.chains.uses[conic.patch][conic.loop]);
    contour.deviation = segment.deviation;
    contour.segments.push_back(std::move(segment));
    return contour;
  }

  Contour loop_contour(std::size_t p, std::size_t l) const {
    const BoundaryLoop& loop = boundary_.patches[p].loops[l];
    Contour contour{number_, p, l, loop.closed, {}, 0, false};
    for (const ChainUse& use : recognition_.chains.uses[p][l]) add_chain(loop, use, contour);
    for (const Segment& segment : contour.segments) {
      contour.deviation = std::max(contour.deviation, segment.deviation);
    }
    return contour;
  }

  void add_chain(const BoundaryLoop& loop, const ChainUse& use, Contour& contour) const {
    const std::vector<PlacedPiece>& pieces = pieces_[use.chain];
    const std::size_t n = loop.vertices.size();
    const EdgeChain& chain = recognition_.chains.chains[use.chain];
    const std::size_t last = chain.vertices.size() - 1;
    const auto vertex = [&](std::size_t of_chain) {
      const std::size_t back = chain.closed ? n - of_chain % n : last - of_chain;
      return loop.vertices[(use.position + (use.reversed ? back : of_chain)) % n];
    };
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const std::size_t at = use.reversed ? pieces.size() - 1 - k : k;
      const PlacedPiece& piece = pieces[at];
      Segment segment;
      segment.from = vertex(use.reversed ? piece.to : piece.from);
      segment.to = vertex(use.reversed ? piece.from : piece.to);
      segment.curve = use.reversed ? reversed(piece.curve) : piece.curve;
      segment.deviation = piece.deviation;
      segment.edge = first_edge_[use.chain] + static_cast<Index>(at);
      segment.edge_count = 1;
      segment.reversed = use.reversed;
      contour.segments.push_back(std::move(segment));
    }
  }

  std::size_t number_;
  const Shell& shell_;
  const ShellBoundary& boundary_;
  const ShellRecognition& recognition_;
  std::vector<std::vector<PlacedPiece>> pieces_;  // by chain
  std::vector<Index> first_edge_;                 // by chain
};

}  // namespace

std::vector<Contour> chain_contours(const Model& model, std::span<const ShellBoundary> boundaries,
                                    const FitOptions& options) {
  const std::vector<ShellRecognition> shells = recognize_model(model, boundaries, options);
  std::vector<std::vector<Contour>> by_shell(shells.size());
  parallel_for(shells.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      by_shell[s] = ShellContours(s, model.shells[s], boundaries[s], shells[s]).contours();
    }
  });
  std::vector<Contour> contours;
  for (std::vector<Contour>& part : by_shell) {
    contours.insert(contours.end(), std::make_move_iterator(part.begin()),
                    std::make_move_iterator(part.end()));
  }
  return contours;
}

}  // namespace meshcontour::detail

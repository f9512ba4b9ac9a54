#include "meshcontour/fit.hpp"
#include "support/catch.hpp"

using namespace meshcontour;

namespace {

Segment along(Index edge, Index count) {
  Segment segment;
  segment.edge = edge;
  segment.edge_count = count;
  return segment;
}

Contour contour(std::size_t shell, std::vector<Segment> segments) {
  Contour result;
  result.shell = shell;
  result.segments = std::move(segments);
  return result;
}

}  // namespace

TEST_CASE("repeated_segments: a second use of an edge is a repeat, in its own shell only", "[fit]") {
  const std::vector<Contour> contours = {contour(0, {along(0, 1), along(1, 1)}), contour(0, {along(1, 1)}),
                                         contour(1, {along(1, 1)})};
  const std::vector<std::vector<bool>> expected = {{false, false}, {true}, {false}};
  CHECK(repeated_segments(contours) == expected);
}

TEST_CASE("repeated_segments: a circle along two edges and its halves stand for each other", "[fit]") {
  const Contour circle = contour(0, {along(3, 2)}), halves = contour(0, {along(3, 1), along(4, 1)});
  const std::vector<std::vector<bool>> circle_first = {{false}, {true, true}};
  const std::vector<std::vector<bool>> halves_first = {{false, false}, {true}};
  CHECK(repeated_segments(std::vector{circle, halves}) == circle_first);
  CHECK(repeated_segments(std::vector{halves, circle}) == halves_first);
}

TEST_CASE("repeated_segments: segments without edges are never repeats", "[fit]") {
  const std::vector<Contour> contours = {contour(0, {Segment{}, Segment{}})};
  CHECK(repeated_segments(contours) == std::vector<std::vector<bool>>{{false, false}});
  CHECK(repeated_segments({}).empty());
}

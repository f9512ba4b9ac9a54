#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "read/findings.hpp"
#include "read/webxml_scan.hpp"

namespace meshcontour::detail {

/// Triangles of one <facets>.
struct FacetData {
  std::vector<Triangle> triangles;
  std::vector<Vector> normals;  ///< three a triangle, or empty
};

/// The text of a body between its tags, and what to say about it.
struct BodySource {
  std::string_view text;
  std::size_t line;         ///< of its first byte in the file
  const std::string& file;  ///< for messages
  std::string element;      ///< for messages, e.g. "shell id3"
};

/// Reads a body of any form through tinyxml2, a few hundred kilobytes at a time: the way for what the scan of
/// the plain form does not take, with the same result where both apply. Elements that do not belong there are
/// left out with a warning.
///
/// @throws Error  BadData with the line for anything but three finite numbers of usual size a point.
std::vector<Point> parse_points(const BodySource& source, BodyKind kind, Findings& findings);

/// @param point_count  every index must be below it.
/// @throws Error       BadData with the line for anything but three indices in range a facet.
FacetData parse_facets(const BodySource& source, std::size_t point_count, Findings& findings);

}  // namespace meshcontour::detail

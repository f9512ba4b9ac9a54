#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/text_source.hpp"
#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// The elements whose content is bulk data.
enum class BodyKind { Vertices, Facets, Polyline };

/// A stretch of a body that begins and ends between items.
struct BodyPiece {
  std::size_t begin = 0, end = 0;  ///< offsets in the file
  std::size_t first_item = 0;      ///< of the items (points or triangles) of the body
  std::size_t items = 0;
};

/// What a body seems to hold if it has the plain form.
struct BodyOutline {
  std::size_t end = 0;      ///< offset of its closing tag
  std::size_t items = 0;    ///< points or triangles
  std::size_t normals = 0;  ///< corner normals
  std::vector<BodyPiece> pieces;
};

/// Finds the closing tag of a body and counts its items, by looking at '<' and what follows only: one cheap
/// pass. Right for plain bodies; for others the scan of a piece fails.
///
/// @param window  on the file; is moved along.
/// @param begin   offset of the body's first byte.
/// @return        nothing if there is no closing tag.
std::optional<BodyOutline> outline_body(TextWindow& window, std::size_t begin, BodyKind kind);

/// The bytes of a piece; those behind it that the scan looks at are readable too.
std::string_view piece_text(const TextSource& source, const BodyPiece& piece, std::string& buffer);

/// Reads a piece of points in the plain form: `<v p="x y z"/>` and white space, nothing else.
///
/// @param piece   as from piece_text.
/// @param points  one for each item.
/// @return        false at anything else, which may be legal: then the body is to be read in the other way.
///                Also for coordinates that need a message.
bool scan_points(std::string_view piece, BodyKind kind, std::span<Point> points);

/// Reads a piece of facets in the plain form: `<f v="i j k" fn="x y z">`, none or three `<n d="x y z"/>`,
/// `</f>`, and white space, nothing else. Facet normals (fn) are not used: the winding gives them.
///
/// @param piece      as from piece_text.
/// @param triangles  one for each item; indices are not checked.
/// @param normals    three for each item, or empty if there are none to come.
/// @param highest    raised to the highest index.
/// @return           as scan_points.
bool scan_facets(std::string_view piece, std::span<Triangle> triangles, std::span<Vector> normals,
                 Index& highest);

/// Coordinates beyond this are worth a warning.
inline constexpr double kUsualCoordinate = 1e15;
/// Coordinates beyond this are refused: their squares and products must stay finite.
inline constexpr double kLargestCoordinate = 1e100;

/// The vector with length 1, itself if it has that to 12 digits; zero if it has no direction.
Vector unit_or_zero(const Vector& v);

}  // namespace meshcontour::detail

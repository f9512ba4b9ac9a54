#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "meshcontour/types.hpp"
#include "read/findings.hpp"
#include "read/webxml_outline.hpp"

namespace meshcontour::detail {

/// Ids that an attribute names.
struct WebxmlReferences {
  std::vector<std::string> ids;
  int digest_line = 0;  ///< for XmlDigest::line, when a message needs it
};

struct WebxmlProduct {
  std::string id, name;
  WebxmlReferences shapes, children;
};

struct WebxmlChild {
  std::string shape;
  std::optional<Eigen::Affine3d> placement;  ///< none: the matrix is unusable, and a warning says so
  int digest_line = 0;
};

struct WebxmlShape {
  std::string id, unit;
  WebxmlReferences shells, annotations;
  std::vector<WebxmlChild> children;
  int digest_line = 0;
};

struct WebxmlFacets {
  std::optional<Rgba> color;
  std::optional<std::size_t> body;  ///< index into WebxmlOutline::bodies; none for <facets/>
};

struct WebxmlShell {
  std::string id;
  std::optional<Rgba> color;
  std::optional<std::string> href;      ///< the content is in another file
  std::optional<std::size_t> vertices;  ///< body
  std::vector<WebxmlFacets> facets;
  int digest_line = 0;
};

struct WebxmlAnnotation {
  std::string id;
  std::optional<std::string> href;
  std::vector<std::size_t> polylines;  ///< bodies
  int digest_line = 0;
};

/// The elements of a webxml file, in file order.
struct WebxmlDocument {
  std::string root_element;
  std::optional<WebxmlReferences> roots;
  std::vector<WebxmlProduct> products;
  std::vector<WebxmlShape> shapes;
  std::vector<WebxmlShell> shells;
  std::vector<WebxmlAnnotation> annotations;
};

/// An element as messages name it, e.g. "shell id3".
std::string element_text(std::string_view name, std::string_view id);

/// Reads products, shapes, shells and annotations through tinyxml2.
///
/// @throws Error  BadData with the line for matrices that are not 16 finite numbers and for a second <verts>.
WebxmlDocument read_document(WebxmlOutline& outline, const std::string& file, Findings& findings);

}  // namespace meshcontour::detail

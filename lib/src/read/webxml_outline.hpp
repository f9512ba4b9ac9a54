#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "read/findings.hpp"
#include "read/webxml_scan.hpp"
#include "read/xml_digest.hpp"

namespace meshcontour::detail {

/// The content of a <verts>, <facets> or <polyline>, cut out of its document.
struct WebxmlBody {
  BodyKind kind = BodyKind::Vertices;
  std::size_t begin = 0, end = 0;  ///< offsets in the file
  bool plain = false;              ///< worth a try with the scan of the plain form
  BodyOutline outline;             ///< when plain
};

/// A webxml file without its bulk.
struct WebxmlOutline {
  XmlDigest digest;                ///< for tinyxml2; each body is replaced by its number in `bodies`
  std::vector<WebxmlBody> bodies;  ///< in file order
  bool guessed = false;  ///< ends of bodies were looked up, not parsed: right if these bodies prove plain
};

/// Checks the structure of a webxml file and cuts out its bodies.
///
/// @param source   must outlive the outline.
/// @param careful  parses every body to its end instead of looking the end up.
/// @throws Error   BadData with the line if the file is not well-formed XML of this kind, or in an encoding
///                 other than UTF-8 and ISO-8859-1.
WebxmlOutline outline_webxml(const TextSource& source, const std::string& file, bool careful,
                             Findings& findings);

/// Whether a body, parsed whatever its form, is well-formed and ends where its outline says.
bool ends_as_outlined(const TextSource& source, const WebxmlBody& body, const std::string& file);

/// Cuts off zero bytes at the end, up to a mebibyte: some downloads are padded.
void cut_padding(TextSource& source, const std::string& file, Findings& findings);

}  // namespace meshcontour::detail

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "meshcontour/model.hpp"
#include "read/format.hpp"
#include "read/webxml_document.hpp"

namespace meshcontour::detail {

/// One webxml file, read: its elements, and the bodies that they hold.
struct WebxmlFile {
  std::string name;
  WebxmlOutline outline;
  WebxmlDocument document;
  std::vector<Shell> shells;  ///< parallel to document.shells; empty where there is an href
  std::vector<std::vector<std::vector<Point>>> polylines;  ///< parallel to document.annotations
  Findings findings;
};

/// Reads a file, but none that it names. The bodies are read in parallel; the result does not depend on the
/// threads.
///
/// @param source   UTF-8 or ISO-8859-1; must live as long as messages may need a line of `outline.digest`.
///                 Padding is cut off.
/// @param careful  reads every body through tinyxml2, as for comparison; otherwise only those that the scan
/// of
///                 the plain form does not take.
/// @throws Error   BadData with the line; OutOfMemory if it holds more triangles than the limit.
WebxmlFile read_webxml_content(TextSource& source, const std::string& name, const ReadOptions& options,
                               bool careful);

}  // namespace meshcontour::detail

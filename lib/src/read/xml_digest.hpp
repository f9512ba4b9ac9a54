#pragma once

#include <tinyxml2.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/line_counter.hpp"
#include "read/xml_scanner.hpp"

namespace meshcontour::detail {

/// The elements and attributes of a document, or of a part of it, as text for tinyxml2: no comments,
/// instructions, character data or text, line ends as LF. Parts may be left out; lines are still those of the
/// original.
class XmlDigest {
 public:
  /// @param original     what the tokens are cut from; must outlive the digest.
  /// @param start, line  where the tokens begin, and the line of that offset.
  explicit XmlDigest(const TextSource& original, std::size_t start = 0, std::size_t line = 1)
      : lines_(original, start, line), sections_{{1, start}} {}

  /// Starts again at a later offset of the original, empty.
  void restart(std::size_t offset);
  /// Appends a tag, or the line ends of any other token.
  void append(XmlToken::Kind kind, std::string_view token);
  /// Appends text that stands for a part of the original up to `end`, which is left out.
  void leave_out(std::string_view stand_in, std::size_t end);

  std::string& text() { return text_; }
  /// Line of the original for a line that tinyxml2 reports. May have to read all that is before it.
  std::size_t line(int digest_line);

 private:
  struct Section {
    std::size_t line;    // of the digest
    std::size_t offset;  // in the original
  };

  LineCounter lines_;
  std::string text_;
  std::size_t line_ = 1;
  std::vector<Section> sections_;
};

/// Parses a digest.
/// @throws Error  BadData if tinyxml2 refuses it after all.
void parse_digest(tinyxml2::XMLDocument& document, XmlDigest& digest, const std::string& file);

}  // namespace meshcontour::detail

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/text_source.hpp"
#include "meshcontour/error.hpp"

namespace meshcontour::detail {

/// One piece of markup, or the text between two.
struct XmlToken {
  enum class Kind { Start, Empty, End, Text, Comment, CharacterData, Instruction, Declaration, EndOfFile };
  Kind kind = Kind::EndOfFile;
  std::size_t begin = 0, end = 0;  ///< offsets of its bytes, which the window shows until the next call
  std::string_view name;           ///< of an element, or target of an instruction; as long as the bytes
};

/// Cuts an XML document into tokens and checks what a lenient parser lets pass [W3C, XML 1.0, fifth edition]:
/// names, attributes given once, no '<' in values, declared entities only, legal characters, no '--' in
/// comments, tags that match, one document element. A DOCTYPE is refused, and so are deeper nesting than
/// kMaxDepth, more attributes than kMaxAttributes and larger tokens than kMaxToken. A long text may come in
/// pieces.
///
/// Bytes of 0x80 and above pass as they are: encodings that extend ASCII can be scanned before they are
/// known.
class XmlScanner {
 public:
  static constexpr std::size_t kMaxDepth = 64;        ///< tinyxml2 takes 98
  static constexpr std::size_t kMaxAttributes = 256;  ///< of an element; tinyxml2 takes time by their square
  static constexpr std::size_t kMaxToken = std::size_t{64} << 20;  ///< bytes of a tag, comment or the like

  /// @param window  on the document; the scanner moves it.
  /// @param file    for messages.
  /// @param begin   offset to start at, inside `depth` open elements whose names do not matter (for a part of
  ///                a document); 0 and 0 for a whole one.
  XmlScanner(TextWindow& window, const std::string& file, std::size_t begin = 0, std::size_t depth = 0);

  /// The next token.
  /// @throws Error  BadData with the line if the document is not well formed here.
  XmlToken next();

  /// Continues at an offset within the same element; what lies between has been checked otherwise.
  void skip_to(std::size_t offset) { look_at(offset, 1); }

  /// Elements open after the token returned last.
  std::size_t depth() const { return base_depth_ + open_.size(); }

  /// Their names, outermost first; those of a part's surroundings are not known.
  const std::vector<std::string>& open_elements() const { return open_; }

  /// @throws Error  BadData with the line of the offset.
  [[noreturn]] void fail_at(std::size_t offset, const std::string& message) const;

 private:
  // All offsets below are in the window's text.
  XmlToken scan();
  XmlToken text();
  XmlToken markup();
  XmlToken comment();
  XmlToken character_data();
  XmlToken instruction();
  XmlToken start_tag();
  XmlToken end_tag();
  void attributes();
  void attribute_value();
  void reference();
  void open(const XmlToken& token);
  std::string_view name(const char* what);
  bool skip_space();
  bool at(std::string_view literal) const { return text_.substr(offset_, literal.size()) == literal; }
  std::size_t find(std::string_view literal, std::size_t from, const char* what) const;
  void check_characters(std::size_t begin, std::size_t end) const;
  void check_unique(std::size_t begin);
  void look_at(std::size_t offset, std::size_t length);
  bool reaches_end() const { return window_.reaches_end(); }
  [[noreturn]] void fail(std::size_t offset, const std::string& message) const;
  [[noreturn]] void fail_too_long(std::size_t offset) const;

  TextWindow& window_;
  const std::string& file_;
  std::string_view text_;   // of the window
  std::size_t base_ = 0;    // offset of text_ in the document
  std::size_t offset_ = 0;  // in text_
  std::size_t base_depth_;
  std::size_t document_begin_ = 0;  // behind a byte order mark
  bool root_seen_ = false;
  std::vector<std::string> open_;
  std::vector<std::string_view> attribute_names_;  // of the tag at hand; kept for its capacity
};

/// The encoding that an XML declaration names, "" if none.
std::string_view declared_encoding(std::string_view declaration);

}  // namespace meshcontour::detail

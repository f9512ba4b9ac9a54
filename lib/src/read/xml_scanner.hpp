#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "meshcontour/error.hpp"

namespace meshcontour::detail {

/// One piece of markup, or the text between two.
struct XmlToken {
  enum class Kind { Start, Empty, End, Text, Comment, CharacterData, Instruction, Declaration, EndOfFile };
  Kind kind = Kind::EndOfFile;
  std::size_t begin = 0, end = 0;  ///< of its bytes
  std::string_view name;           ///< of an element, or target of an instruction
};

/// Cuts an XML document into tokens and checks what a lenient parser lets pass [W3C, XML 1.0, fifth edition]:
/// names, attributes given once, no '<' in values, declared entities only, legal characters, no '--' in
/// comments, tags that match, one document element. A DOCTYPE is refused, and so are deeper nesting than
/// kMaxDepth and more attributes than kMaxAttributes.
///
/// Bytes of 0x80 and above pass as they are: encodings that extend ASCII can be scanned before they are
/// known.
class XmlScanner {
 public:
  static constexpr std::size_t kMaxDepth = 64;        ///< tinyxml2 takes 98
  static constexpr std::size_t kMaxAttributes = 256;  ///< of one element; tinyxml2 takes time by their square

  /// @param file   for messages.
  /// @param begin  offset to start at, inside `depth` open elements whose names do not matter (for a part of
  /// a
  ///               document); 0 and 0 for a whole one.
  XmlScanner(std::string_view text, const std::string& file, std::size_t begin = 0, std::size_t depth = 0);

  /// The next token.
  /// @throws Error  BadData with the line if the document is not well formed here.
  XmlToken next();

  /// Continues at an offset within the same element; what lies between has been checked otherwise.
  void skip_to(std::size_t offset) { offset_ = offset; }

  /// Elements open after the token returned last.
  std::size_t depth() const { return base_depth_ + open_.size(); }

  /// Their names, outermost first; those of a part's surroundings are not known.
  const std::vector<std::string_view>& open_elements() const { return open_; }

  /// @throws Error  BadData with the line of the offset.
  [[noreturn]] void fail(std::size_t offset, const std::string& message) const;

 private:
  XmlToken text();
  XmlToken markup();
  XmlToken comment();
  XmlToken character_data();
  XmlToken instruction();
  XmlToken start_tag();
  XmlToken end_tag();
  void attributes(std::vector<std::string_view>& names);
  void attribute_value();
  void reference();
  void open(const XmlToken& token);
  std::string_view name(const char* what);
  bool skip_space();
  bool at(std::string_view literal) const { return text_.substr(offset_, literal.size()) == literal; }
  void check_characters(std::size_t begin, std::size_t end) const;
  void check_unique(std::vector<std::string_view>& names, std::size_t begin) const;

  std::string_view text_;
  const std::string& file_;
  std::size_t offset_;
  std::size_t base_depth_;
  bool root_seen_ = false;
  std::vector<std::string_view> open_;
  std::vector<std::string_view> attribute_names_;  // of the tag at hand; kept for its capacity
};

/// The encoding that an XML declaration names, "" if none.
std::string_view declared_encoding(std::string_view declaration);

}  // namespace meshcontour::detail

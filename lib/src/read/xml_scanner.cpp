#include "read/xml_scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "base/line_counter.hpp"

namespace meshcontour::detail {
namespace {

using Kind = XmlToken::Kind;

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool starts_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':' ||
         static_cast<unsigned char>(c) >= 0x80;
}

bool continues_name(char c) {
  return starts_name(c) || (c >= '0' && c <= '9') || c == '-' || c == '.';
}

// A shorter rest of the window is not scanned: more than a literal or a reference takes.
constexpr std::size_t kLookAhead = 128;

// The window ends within the token at hand.
struct CutOff {};

bool is_illegal(char c) {
  return static_cast<unsigned char>(c) < 0x20 && !is_space(c);
}

bool is_legal_character(unsigned long code) {
  return code == 0x9 || code == 0xA || code == 0xD || (code >= 0x20 && code <= 0xD7FF) ||
         (code >= 0xE000 && code <= 0xFFFD) || (code >= 0x10000 && code <= 0x10FFFF);
}

}  // namespace

XmlScanner::XmlScanner(TextWindow& window, const std::string& file, std::size_t begin, std::size_t depth)
    : window_(window), file_(file), base_depth_(depth), root_seen_(depth > 0) {
  look_at(begin, 1);
  if (begin == 0 && at("\xEF\xBB\xBF")) offset_ = document_begin_ = 3;
}

void XmlScanner::look_at(std::size_t offset, std::size_t length) {
  window_.show(offset, std::max(length, kLookAhead));
  text_ = window_.text();
  base_ = window_.begin();
  offset_ = std::min(offset - base_, text_.size());
}

void XmlScanner::fail_at(std::size_t offset, const std::string& message) const {
  LineCounter lines(window_.source());
  throw Error(ErrorCode::BadData, message, Spot{file_, lines.line(offset), lines.column(offset), ""});
}

// What looks wrong near the end of the window may be right once more is seen.
void XmlScanner::fail(std::size_t offset, const std::string& message) const {
  if (!reaches_end() && offset_ + kLookAhead > text_.size()) throw CutOff{};
  fail_at(base_ + offset, message);
}

void XmlScanner::fail_too_long(std::size_t offset) const {
  fail_at(base_ + offset, fmt::format("markup of more than {} bytes", kMaxToken));
}

// A token is scanned again, in a window that begins with it and is as large as it takes, when the window cuts
// it off.
XmlToken XmlScanner::next() {
  if (offset_ + kLookAhead > text_.size()) look_at(base_ + offset_, 1);
  while (true) {
    const std::size_t begin = offset_;
    try {
      XmlToken token = scan();
      const bool may_go_on = token.kind == Kind::Text && offset_ == text_.size() && !reaches_end();
      if (!may_go_on || begin == 0) {
        if (token.kind != Kind::Text && token.end - token.begin > kMaxToken) fail_too_long(begin);
        token.begin += base_;
        token.end += base_;
        return token;
      }
    } catch (const CutOff&) {
      // as below
    }
    const std::size_t rest = text_.size() - begin;
    if (rest > kMaxToken) fail_too_long(begin);
    look_at(base_ + begin, begin > 0 ? rest + 1 : 2 * rest);
  }
}

XmlToken XmlScanner::scan() {
  if (offset_ < text_.size()) return text_[offset_] == '<' ? markup() : text();
  if (!open_.empty()) fail(offset_, fmt::format("the file ends inside <{}>", printable(open_.back(), 40)));
  if (!root_seen_) fail(offset_, "no document element");
  return {Kind::EndOfFile, offset_, offset_, {}};
}

XmlToken XmlScanner::text() {
  const std::size_t begin = offset_;
  while (offset_ < text_.size() && text_[offset_] != '<') {
    const char c = text_[offset_];
    if (is_illegal(c)) fail(offset_, "an illegal control character");
    if (depth() == 0 && !is_space(c)) {
      fail(offset_, root_seen_ ? "text after the document element" : "text before the document element");
    }
    if (c == ']' && at("]]>")) fail(offset_, "']]>' in text");
    if (c == '&') {
      reference();
    } else {
      ++offset_;
    }
  }
  return {Kind::Text, begin, offset_, {}};
}

XmlToken XmlScanner::markup() {
  if (at("<!--")) return comment();
  if (at("<![CDATA[")) return character_data();
  if (at("<!DOCTYPE")) fail(offset_, "a DOCTYPE is refused: the format needs none");
  if (at("<!")) fail(offset_, "unknown markup after '<!'");
  if (at("<?")) return instruction();
  return at("</") ? end_tag() : start_tag();
}

std::size_t XmlScanner::find(std::string_view literal, std::size_t from, const char* what) const {
  const std::size_t found = text_.find(literal, from);
  if (found != text_.npos) return found;
  if (!reaches_end()) throw CutOff{};
  fail(offset_, fmt::format("{} that does not end", what));
}

XmlToken XmlScanner::comment() {
  const std::size_t begin = offset_;
  const std::size_t end = find("--", begin + 4, "a comment");
  if (end + 3 > text_.size() && !reaches_end()) throw CutOff{};
  if (text_.substr(end, 3) != "-->") fail(end, "'--' inside a comment");
  check_characters(begin, end);
  offset_ = end + 3;
  return {Kind::Comment, begin, offset_, {}};
}

XmlToken XmlScanner::character_data() {
  const std::size_t begin = offset_;
  if (depth() == 0) fail(begin, "a CDATA section outside the document element");
  const std::size_t end = find("]]>", begin, "a CDATA section");
  check_characters(begin, end);
  offset_ = end + 3;
  return {Kind::CharacterData, begin, offset_, {}};
}

XmlToken XmlScanner::instruction() {
  const std::size_t begin = offset_;
  const std::size_t end = find("?>", begin, "a processing instruction");
  offset_ = begin + 2;
  const std::string_view target = name("a processing instruction");
  if (end != offset_ && !is_space(text_[offset_])) {
    fail(offset_, "a blank is missing after the instruction's name");
  }
  check_characters(begin, end);
  if (target == "xml" && base_ + begin == document_begin_) {
    offset_ = end + 2;
    return {Kind::Declaration, begin, offset_, target};
  }
  if (target.size() == 3 && (target[0] | 0x20) == 'x' && (target[1] | 0x20) == 'm' &&
      (target[2] | 0x20) == 'l') {
    fail(begin, "an XML declaration that is not at the start of the file");
  }
  offset_ = end + 2;
  return {Kind::Instruction, begin, offset_, target};
}

XmlToken XmlScanner::start_tag() {
  XmlToken token{Kind::Start, offset_, 0, {}};
  if (depth() == 0 && root_seen_) fail(offset_, "a second document element");
  ++offset_;
  token.name = name("a tag");
  attributes();
  if (at("/>")) {
    token.kind = Kind::Empty;
    offset_ += 2;
  } else if (at(">")) {
    ++offset_;
  } else {
    fail(token.begin, fmt::format("the tag <{} does not end", printable(token.name, 40)));
  }
  token.end = offset_;
  check_unique(token.begin);
  open(token);
  return token;
}

void XmlScanner::open(const XmlToken& token) {
  root_seen_ = true;
  if (depth() >= kMaxDepth) fail(token.begin, fmt::format("elements nested deeper than {}", kMaxDepth));
  if (token.kind == Kind::Start) open_.emplace_back(token.name);
}

XmlToken XmlScanner::end_tag() {
  XmlToken token{Kind::End, offset_, 0, {}};
  offset_ += 2;
  token.name = name("an end tag");
  skip_space();
  if (!at(">")) fail(token.begin, fmt::format("the tag </{} does not end", printable(token.name, 40)));
  token.end = ++offset_;
  if (open_.empty()) {
    if (depth() > 0) return token;  // closes what a part of a document lies in
    fail(token.begin, fmt::format("</{}> closes nothing", printable(token.name, 40)));
  }
  if (open_.back() != token.name) {
    fail(token.begin,
         fmt::format("</{}> where </{}> must come", printable(token.name, 40), printable(open_.back(), 40)));
  }
  open_.pop_back();
  return token;
}

void XmlScanner::attributes() {
  std::vector<std::string_view>& names = attribute_names_;
  names.clear();
  while (true) {
    const bool space = skip_space();
    if (offset_ >= text_.size() || text_[offset_] == '>' || text_[offset_] == '/') return;
    if (!space) fail(offset_, "a blank is missing before an attribute");
    if (names.size() == kMaxAttributes) fail(offset_, fmt::format("more than {} attributes", kMaxAttributes));
    names.push_back(name("an attribute"));
    skip_space();
    if (!at("=")) fail(offset_, fmt::format("attribute '{}' has no value", printable(names.back(), 40)));
    ++offset_;
    skip_space();
    attribute_value();
  }
}

void XmlScanner::attribute_value() {
  const std::size_t begin = offset_;
  if (!at("\"") && !at("'")) fail(offset_, "an attribute value without quotes");
  const char quote = text_[offset_++];
  while (offset_ < text_.size() && text_[offset_] != quote) {
    const char c = text_[offset_];
    if (c == '<') fail(offset_, "'<' in an attribute value");
    if (is_illegal(c)) fail(offset_, "an illegal control character");
    if (c == '&') {
      reference();
    } else {
      ++offset_;
    }
  }
  if (offset_ >= text_.size()) fail(begin, "an attribute value that does not end");
  ++offset_;
}

void XmlScanner::reference() {
  const std::size_t begin = offset_;
  const std::size_t end = text_.substr(begin, 80).find(';');
  if (end == std::string_view::npos) fail(begin, "'&' that starts no reference");
  std::string_view body = text_.substr(begin + 1, end - 1);
  offset_ = begin + end + 1;
  constexpr std::array<std::string_view, 5> kDeclared = {"lt", "gt", "amp", "quot", "apos"};
  if (std::ranges::find(kDeclared, body) != kDeclared.end()) return;
  if (!body.starts_with('#')) fail(begin, fmt::format("entity '&{};' is not declared", printable(body, 40)));
  body.remove_prefix(1);
  const int base = body.starts_with('x') ? 16 : 10;
  if (base == 16) body.remove_prefix(1);
  unsigned long code = 0;
  const auto [last, error] = std::from_chars(body.data(), body.data() + body.size(), code, base);
  const bool whole = error == std::errc() && last == body.data() + body.size();
  if (!whole || !is_legal_character(code)) fail(begin, "a reference to an illegal character");
}

std::string_view XmlScanner::name(const char* what) {
  const std::size_t begin = offset_;
  if (begin >= text_.size() || !starts_name(text_[begin]))
    fail(begin, fmt::format("{} has no valid name", what));
  while (offset_ < text_.size() && continues_name(text_[offset_])) ++offset_;
  return text_.substr(begin, offset_ - begin);
}

bool XmlScanner::skip_space() {
  const std::size_t begin = offset_;
  while (offset_ < text_.size() && is_space(text_[offset_])) ++offset_;
  return offset_ > begin;
}

void XmlScanner::check_characters(std::size_t begin, std::size_t end) const {
  for (std::size_t i = begin; i < end; ++i) {
    if (is_illegal(text_[i])) fail(i, "an illegal control character");
  }
}

void XmlScanner::check_unique(std::size_t begin) {
  if (attribute_names_.size() < 2) return;
  std::ranges::sort(attribute_names_);
  const auto twice = std::ranges::adjacent_find(attribute_names_);
  if (twice != attribute_names_.end()) {
    fail(begin, fmt::format("attribute '{}' is given twice", printable(*twice, 40)));
  }
}

std::string_view declared_encoding(std::string_view declaration) {
  const std::size_t key = declaration.find("encoding");
  if (key == declaration.npos) return {};
  const std::size_t open = declaration.find_first_of("\"'", key);
  if (open == declaration.npos) return {};
  const std::size_t close = declaration.find(declaration[open], open + 1);
  return close == declaration.npos ? std::string_view() : declaration.substr(open + 1, close - open - 1);
}

}  // namespace meshcontour::detail

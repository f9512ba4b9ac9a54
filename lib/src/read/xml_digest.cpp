#include "read/xml_digest.hpp"

#include <algorithm>

namespace meshcontour::detail {

void XmlDigest::restart(std::size_t offset) {
  text_.clear();
  line_ = 1;
  sections_.assign(1, {1, offset});
}

void XmlDigest::append(const XmlToken& token) {
  using Kind = XmlToken::Kind;
  const bool tag = token.kind == Kind::Start || token.kind == Kind::Empty || token.kind == Kind::End;
  append_normalized(original_.substr(token.begin, token.end - token.begin), !tag);
}

void XmlDigest::append_normalized(std::string_view part, bool line_ends_only) {
  for (std::size_t i = 0; i < part.size(); ++i) {
    char c = part[i];
    if (c == '\r') {
      if (i + 1 < part.size() && part[i + 1] == '\n') continue;
      c = '\n';
    }
    if (c == '\n') ++line_;
    if (c == '\n' || !line_ends_only) text_ += c;
  }
}

void XmlDigest::leave_out(std::string_view stand_in, std::size_t end) {
  text_ += stand_in;
  text_ += '\n';
  sections_.push_back({++line_, end});
}

std::size_t XmlDigest::line(int digest_line) {
  const auto wanted = static_cast<std::size_t>(std::max(digest_line, 1));
  const auto after = std::ranges::upper_bound(sections_, wanted, {}, &Section::line);
  const Section& section = *std::prev(after);
  return lines_.line(section.offset) + (wanted - section.line);
}

void parse_digest(tinyxml2::XMLDocument& document, XmlDigest& digest, const std::string& file) {
  if (document.Parse(digest.text().data(), digest.text().size()) == tinyxml2::XML_SUCCESS) return;
  const Spot spot{file, digest.line(document.ErrorLineNum()), 0, ""};
  throw Error(ErrorCode::BadData, "not well-formed XML (" + printable(document.ErrorName()) + ")", spot);
}

}  // namespace meshcontour::detail

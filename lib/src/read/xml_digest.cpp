#include "read/xml_digest.hpp"

#include <algorithm>

namespace meshcontour::detail {

void XmlDigest::restart(std::size_t offset) {
  text_.clear();
  line_ = 1;
  sections_.assign(1, {1, offset});
}

void XmlDigest::append(XmlToken::Kind kind, std::string_view token) {
  using Kind = XmlToken::Kind;
  const bool tag = kind == Kind::Start || kind == Kind::Empty || kind == Kind::End;
  for (std::size_t i = 0; i < token.size(); ++i) {
    char c = token[i];
    if (c == '\r') {
      if (i + 1 < token.size() && token[i + 1] == '\n') continue;
      c = '\n';
    }
    if (c == '\n') ++line_;
    if (c == '\n' || tag) text_ += c;
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

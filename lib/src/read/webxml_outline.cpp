#include "read/webxml_outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "base/line_counter.hpp"
#include "read/encoding.hpp"

namespace meshcontour::detail {
namespace {

using Kind = XmlToken::Kind;

// A plain item takes at least so many bytes; more items than that are not what they seem.
constexpr std::size_t kShortestItem = std::string_view("<f v=\"0 0 0\"/>").size();
constexpr std::size_t kPaddingLimit = std::size_t{1} << 20;

// The body that a start tag opens, if it opens one: `open` ends with the tag's own name.
std::optional<BodyKind> body_kind(const std::vector<std::string>& open) {
  const std::size_t depth = open.size();
  if (depth < 2 || depth > 3) return std::nullopt;
  const std::string_view parent = open[depth - 2], name = open[depth - 1];
  if (depth == 3 && (open[0] == "shell" || open[0] == "annotation")) return std::nullopt;
  if (parent == "shell" && name == "verts") return BodyKind::Vertices;
  if (parent == "shell" && name == "facets") return BodyKind::Facets;
  if (parent == "annotation" && name == "polyline") return BodyKind::Polyline;
  return std::nullopt;
}

// The end tag of the element that the scanner is in.
XmlToken scan_to_end_tag(XmlScanner& scanner) {
  const std::size_t depth = scanner.depth();
  while (true) {
    const XmlToken token = scanner.next();
    if (token.kind == Kind::End && scanner.depth() < depth) return token;
  }
}

class Outliner {
 public:
  Outliner(const TextSource& source, const std::string& file, bool careful, Findings& findings)
      : file_(file),
        careful_(careful),
        findings_(findings),
        window_(source),
        scanner_(window_, file),
        outline_{XmlDigest(source), {}, false} {}

  WebxmlOutline run() {
    for (XmlToken token = scanner_.next(); token.kind != Kind::EndOfFile; token = scanner_.next()) {
      const std::string_view bytes = window_.part(token.begin, token.end);
      if (token.kind == Kind::Declaration) encoding_ = declared_encoding(bytes);
      if (token.kind == Kind::Text || token.kind == Kind::CharacterData) report_text(token.begin, bytes);
      const bool tag = token.kind == Kind::Start || token.kind == Kind::Empty;
      if (tag && scanner_.depth() <= 1) check_root(token);
      outline_.digest.append(token.kind, bytes);
      if (token.kind != Kind::Start) continue;
      if (const auto kind = body_kind(scanner_.open_elements())) cut_body(*kind, token.end);
    }
    make_utf8();
    return std::move(outline_);
  }

 private:
  void check_root(const XmlToken& token) {
    if (root_seen_) return;
    root_seen_ = true;
    constexpr std::array<std::string_view, 4> kRoots = {"step-assembly", "assembly", "shell", "annotation"};
    if (std::ranges::find(kRoots, token.name) != kRoots.end()) return;
    scanner_.fail_at(token.begin,
                     fmt::format("not a webxml file: the document element is <{}>, not <step-assembly>",
                                 printable(token.name, 40)));
  }

  void cut_body(BodyKind kind, std::size_t begin) {
    WebxmlBody body{kind, begin, begin, false, {}};
    std::optional<BodyOutline> guess;
    if (!careful_) guess = outline_body(window_, begin, kind);
    if (guess) {
      outline_.guessed = true;
      body.end = guess->end;
      body.plain = guess->items <= (guess->end - begin) / kShortestItem;
      body.outline = std::move(*guess);
      scanner_.skip_to(body.end);
      outline_.digest.leave_out(std::to_string(outline_.bodies.size()), body.end);
    } else {
      careful_ = true;  // or every later body might be searched to the end of the file
      const XmlToken closing = scan_to_end_tag(scanner_);
      body.end = closing.begin;
      outline_.digest.leave_out(std::to_string(outline_.bodies.size()), body.end);
      outline_.digest.append(closing.kind, window_.part(closing.begin, closing.end));
    }
    outline_.bodies.push_back(std::move(body));
  }

  void report_text(std::size_t offset, std::string_view bytes) {
    const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
    if (begin == bytes.npos) return;
    findings_.note("text", [&] {
      LineCounter lines(window_.source());
      return std::pair("text between elements is not read", Spot{file_, lines.line(offset + begin), 0, ""});
    });
  }

  void make_utf8() {
    std::string& text = outline_.digest.text();
    std::string name;
    for (const char c : encoding_) name += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    if (name == "ISO-8859-1" || name == "LATIN1" || name == "LATIN-1") {
      text = utf8_from_latin1(text);
      return;
    }
    if (!name.empty() && name != "UTF-8" && name != "UTF8" && name != "US-ASCII" && name != "ASCII" &&
        name != "UTF-16") {
      throw Error(ErrorCode::BadData, fmt::format("encoding '{}' is not supported", printable(encoding_, 40)),
                  Spot{file_, 1, 0, ""});
    }
    const std::size_t wrong = find_invalid_utf8(text);
    if (wrong == text.npos) return;
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(wrong), '\n');
    const auto byte = static_cast<unsigned>(static_cast<unsigned char>(text[wrong]));
    findings_.warn("encoding", [&] {
      return std::pair(fmt::format("byte 0x{:02x} is not UTF-8: the file is read as ISO-8859-1", byte),
                       Spot{file_, outline_.digest.line(static_cast<int>(line)), 0, ""});
    });
    text = utf8_from_latin1(text);
  }

  const std::string& file_;
  bool careful_;
  Findings& findings_;
  TextWindow window_;
  XmlScanner scanner_;
  WebxmlOutline outline_;
  std::string encoding_;
  bool root_seen_ = false;
};

}  // namespace

void cut_padding(TextSource& source, const std::string& file, Findings& findings) {
  std::string buffer;
  const std::size_t size = source.size();
  if (!source.view(size - std::min<std::size_t>(size, 1), size, buffer).starts_with('\0')) return;
  const std::string_view tail = source.view(size - std::min(size, kPaddingLimit), size, buffer);
  const std::size_t last = tail.find_last_not_of('\0');
  if (last == tail.npos) return;
  const std::size_t padding = tail.size() - last - 1;
  findings.warn("padding", [&] {
    return std::pair(fmt::format("{} zero bytes at the end are ignored", padding), Spot{file, 0, 0, ""});
  });
  source.cut(size - padding);
}

WebxmlOutline outline_webxml(const TextSource& source, const std::string& file, bool careful,
                             Findings& findings) {
  if (!careful) {
    try {
      Findings found;
      WebxmlOutline outline = Outliner(source, file, false, found).run();
      findings.merge(found);
      return outline;
    } catch (const Error&) {
      // A wrong guess may have caused it: the careful way tells what really is wrong.
    }
  }
  return Outliner(source, file, true, findings).run();
}

bool ends_as_outlined(const TextSource& source, const WebxmlBody& body, const std::string& file) {
  try {
    TextWindow window(source);
    constexpr std::size_t kDepth = 3;
    XmlScanner scanner(window, file, body.begin, kDepth);
    while (true) {
      const bool outermost = scanner.depth() == kDepth;
      const XmlToken token = scanner.next();
      if (token.kind == Kind::EndOfFile || token.begin > body.end) return false;
      if (token.kind == Kind::End && outermost) return token.begin == body.end;
    }
  } catch (const Error&) {
    return false;
  }
}

}  // namespace meshcontour::detail

#include "base/escape.hpp"

#include <fmt/format.h>

#include <limits>

#include "base/utf8.hpp"
#include "meshcontour/error.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

// Calls piece(code, bytes) for each character; the bytes are valid UTF-8.
template <typename Piece>
void for_each_character(std::string_view text, const Piece& piece) {
  while (!text.empty()) {
    bool valid = false;
    const DecodedCharacter character = decode_utf8(text, &valid);
    piece(character.code, valid ? text.substr(0, character.length) : kReplacement);
    text.remove_prefix(character.length);
  }
}

bool allowed_in_xml(char32_t code) {
  if (code < 0x20) return code == '\t' || code == '\n' || code == '\r';
  return code != 0xFFFE && code != 0xFFFF;
}

}  // namespace

std::string json_quoted(std::string_view text) {
  std::string out = "\"";
  for_each_character(text, [&](char32_t code, std::string_view bytes) {
    if (code == '"' || code == '\\') out += '\\';
    // U+2028 and U+2029 end a line in JavaScript; DEL and C1 controls are commands to terminals.
    if (code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(code));
    } else {
      out += bytes;
    }
  });
  return out + '"';
}

std::string xml_escaped(std::string_view text) {
  std::string out;
  for_each_character(text, [&](char32_t code, std::string_view bytes) {
    switch (code) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&apos;";
        break;
      default:
        if (!allowed_in_xml(code)) {
          out += kReplacement;
        } else if (code < 0x20 || (code >= 0x7F && code < 0xA0)) {
          out += fmt::format("&#{};", static_cast<unsigned>(code));
        } else {
          out += bytes;
        }
    }
  });
  return out;
}

std::string csv_field(std::string_view text) {
  std::string out = printable(text, std::numeric_limits<std::size_t>::max());
  if (!out.empty() && std::string_view("=+-@").find(out[0]) != std::string_view::npos) out.insert(0, 1, '\'');
  const bool plain =
      out.find_first_of(",\"'") == std::string::npos && !out.starts_with(' ') && !out.ends_with(' ');
  if (plain) return out;
  std::string quoted = "\"";
  for (const char c : out) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

std::string one_word(std::string_view text) {
  std::string out;
  for_each_character(text, [&](char32_t code, std::string_view bytes) {
    const bool kept = code > 0x20 && code != '#' && code != '\\' && !(code >= 0x7F && code <= 0xA0);
    if (kept) {
      out += bytes;
    } else {
      out += '_';
    }
  });
  return out.empty() ? "_" : out;
}

}  // namespace meshcontour::detail

#include "meshcontour/error.hpp"

#include <fmt/format.h>

namespace meshcontour {
namespace {

// Length of the valid UTF-8 sequence at the start of the text, 0 where there is none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  const unsigned second = byte(1);
  const bool overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
  const bool outside = (lead == 0xED && second > 0x9F) || (lead == 0xF4 && second > 0x8F);
  return overlong || outside ? 0 : length;
}

}  // namespace

std::string printable(std::string_view text, std::size_t limit) {
  std::string out;
  while (!text.empty()) {
    if (out.size() >= limit) return out + "...";
    const auto lead = static_cast<unsigned char>(text[0]);
    const std::size_t length = utf8_length(text);
    const bool c1_control = length == 2 && lead == 0xC2 && static_cast<unsigned char>(text[1]) < 0xA0;
    if (lead < 0x20 || lead == 0x7F) {
      out += fmt::format("\\x{:02x}", lead);
    } else if (length == 0 || c1_control) {
      out += "\xEF\xBF\xBD";
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out;
}

std::string Spot::text() const {
  std::string out = printable(file);
  if (line > 0) out += fmt::format("{}{}", out.empty() ? "line " : ":", line);
  if (line > 0 && column > 0) out += fmt::format(":{}", column);
  if (!element.empty()) out += fmt::format("{}{}", out.empty() ? "" : ": ", printable(element));
  return out;
}

Error::Error(ErrorCode code, const std::string& message, Spot spot)
    : std::runtime_error(spot.text().empty() ? message : spot.text() + ": " + message),
      code_(code),
      spot_(std::move(spot)) {}

std::string Diagnostic::text() const {
  const std::string where = spot.text();
  return fmt::format("{}{}{}: {}{}", where, where.empty() ? "" : ": ",
                     severity == Severity::Warning ? "warning" : "note", printable(message, 1000),
                     count > 1 ? fmt::format(" ({} times)", count) : "");
}

}  // namespace meshcontour

#include "meshcontour/error.hpp"

#include <fmt/format.h>

#include "base/utf8.hpp"

namespace meshcontour {
std::string printable(std::string_view text, std::size_t limit) {
  std::string out;
  while (!text.empty()) {
    if (out.size() >= limit) return out + "...";
    bool valid = false;
    const auto [code, length] = detail::decode_utf8(text, &valid);
    const bool c1_control = code >= 0x80 && code < 0xA0;
    if (code < 0x20 || code == 0x7F) {
      out += fmt::format("\\x{:02x}", static_cast<unsigned>(code));
    } else if (!valid || c1_control) {
      out += "\xEF\xBF\xBD";
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(length);
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

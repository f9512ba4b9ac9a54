#include "messages.hpp"

#include <fmt/format.h>

namespace meshcontour::app {
namespace {

std::string_view kind_name(MessageKind kind) {
  switch (kind) {
    case MessageKind::Error:
      return "error";
    case MessageKind::Warning:
      return "warning";
    default:
      return "notice";
  }
}

// Percent, ends of lines and, in a property, what separates properties.
std::string escaped(std::string_view text, bool property) {
  std::string out;
  for (const char c : text) {
    const bool special = c == '%' || c == '\r' || c == '\n' || (property && (c == ':' || c == ','));
    if (special) {
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out;
}

std::string github_command(MessageKind kind, std::string_view text, const Spot& spot) {
  std::string properties;
  const auto add = [&](std::string_view name, std::string_view value) {
    properties += fmt::format("{}{}={}", properties.empty() ? " " : ",", name, escaped(value, true));
  };
  if (!spot.file.empty()) add("file", spot.file);
  if (spot.line > 0) add("line", fmt::format("{}", spot.line));
  if (spot.line > 0 && spot.column > 0) add("col", fmt::format("{}", spot.column));
  return fmt::format("::{}{}::{}\n", kind_name(kind), properties, escaped(text, false));
}

}  // namespace

std::string message_line(MessageKind kind, std::string_view text, const Spot& spot, MessageStyle style) {
  if (style == MessageStyle::GitHub) return github_command(kind, text, spot);
  return fmt::format("meshcontour: {}\n", text);
}

}  // namespace meshcontour::app

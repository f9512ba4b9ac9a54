#include "write/step_text.hpp"

#include <fmt/format.h>

#include <iterator>

#include "base/utf8.hpp"

namespace meshcontour::detail {

std::string step_string(std::string_view text) {
  std::string out = "'";
  auto end = std::back_inserter(out);
  while (!text.empty()) {
    const auto [code, length] = decode_utf8(text);
    text.remove_prefix(length);
    if (code == '\'' || code == '\\') {
      out.append(2, static_cast<char>(code));
    } else if (code >= 0x20 && code < 0x7F) {
      out += static_cast<char>(code);
    } else if (code > 0xFFFF) {
      fmt::format_to(end, "\\X4\\{:08X}\\X0\\", static_cast<unsigned>(code));
    } else {
      fmt::format_to(end, "\\X2\\{:04X}\\X0\\", static_cast<unsigned>(code));
    }
  }
  return out + '\'';
}

}  // namespace meshcontour::detail

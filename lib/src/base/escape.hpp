#pragma once

// Texts of other people's files, as the text formats hold them. Invalid UTF-8 becomes U+FFFD everywhere.

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>

namespace meshcontour::detail {

/// A JSON string with its quotes. [RFC 8259]
std::string json_quoted(std::string_view text);

/// Prints as a JSON number, or null where it is not finite.
struct JsonNumber {
  double value;
};

/// Text for XML content and for attributes in either kind of quotes; characters that XML 1.0 does not allow
/// become U+FFFD.
std::string xml_escaped(std::string_view text);

/// A CSV field, quoted where needed [RFC 4180]. Control characters are made visible, and a text that a
/// spreadsheet would take for a formula gets a leading apostrophe.
std::string csv_field(std::string_view text);

/// The text as one word: blanks, control characters, '#' and '\' become '_'; "_" if it is empty.
std::string one_word(std::string_view text);

}  // namespace meshcontour::detail

template <>
struct fmt::formatter<meshcontour::detail::JsonNumber> : fmt::formatter<double> {
  template <typename Context>
  auto format(meshcontour::detail::JsonNumber number, Context& context) const {
    if (std::isfinite(number.value)) return fmt::formatter<double>::format(number.value, context);
    return fmt::format_to(context.out(), "null");
  }
};

#pragma once

// Texts of other people's files, as the text formats hold them. Invalid UTF-8 becomes U+FFFD everywhere.

#include <string>
#include <string_view>

namespace meshcontour::detail {

/// A JSON string with its quotes. [RFC 8259]
std::string json_quoted(std::string_view text);

/// A JSON number, or null where it is not finite.
std::string json_number(double value);

/// Text for XML content and for attributes in either kind of quotes; characters that XML 1.0 does not allow
/// become U+FFFD.
std::string xml_escaped(std::string_view text);

/// A CSV field, quoted where needed [RFC 4180]. Control characters are made visible, and a text that a
/// spreadsheet would take for a formula gets a leading apostrophe.
std::string csv_field(std::string_view text);

/// The text as one word: blanks, control characters, '#' and '\' become '_'; "_" if it is empty.
std::string one_word(std::string_view text);

}  // namespace meshcontour::detail

#include "read/xml_words.hpp"

#include <algorithm>

#include "base/text_cursor.hpp"

namespace meshcontour::detail {

std::vector<std::string_view> xml_words(std::string_view text) {
  constexpr std::string_view kSpace = " \t\n\r";
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = std::min(text.find_first_not_of(kSpace), text.size());
    text.remove_prefix(begin);
    if (text.empty()) return words;
    const std::size_t length = std::min(text.find_first_of(kSpace), text.size());
    words.push_back(text.substr(0, length));
    text.remove_prefix(length);
  }
}

std::optional<Vector> xml_vector(std::string_view text) {
  const auto words = xml_words(text);
  if (words.size() != 3) return std::nullopt;
  Vector v;
  for (int k = 0; k < 3; ++k) {
    const auto number = parse_number(words[static_cast<std::size_t>(k)]);
    if (!number) return std::nullopt;
    v[k] = *number;
  }
  return v;
}

}  // namespace meshcontour::detail

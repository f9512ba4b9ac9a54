#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// The words of an attribute value, between white space as XML has it.
std::vector<std::string_view> xml_words(std::string_view text);

/// Exactly three finite numbers.
std::optional<Vector> xml_vector(std::string_view text);

}  // namespace meshcontour::detail

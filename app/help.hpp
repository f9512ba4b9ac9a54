#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <string_view>

namespace meshcontour::app {

/// The help's layout: at most 80 columns.
std::shared_ptr<CLI::Formatter> help_formatter();

/// The long name that is nearest to a mistyped one, by the number of letters to change [Levenshtein 1966];
/// empty when none is near.
std::string nearest_option(const CLI::App& parser, std::string_view typed);

}  // namespace meshcontour::app

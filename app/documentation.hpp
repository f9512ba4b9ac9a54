#pragma once

// Texts about the program, all made from its one table of options.

#include <array>
#include <string>

#include "choices.hpp"
#include "option_group.hpp"

namespace meshcontour::app {

enum class CommandShell { Bash, Zsh, Fish };

inline constexpr Choices<CommandShell, 3> kCommandShells = {
    {{"bash", CommandShell::Bash}, {"zsh", CommandShell::Zsh}, {"fish", CommandShell::Fish}}};

/// The manual page, section 1, in roff's man macros.
std::string manual_page(const OptionTable& table);

/// A script that teaches a shell the options, their words and where files belong.
std::string completion_script(const OptionTable& table, CommandShell shell);

/// A configuration file in TOML: options that were given, and the others with their defaults as comments.
std::string configuration(const OptionTable& table);

}  // namespace meshcontour::app

#pragma once

#include "command_line.hpp"

namespace meshcontour::app {

/// Runs the job of every input, one after the other, and says what went wrong with each.
///
/// @return         the exit code: 0 all good; the error's own code with one input, 1 with several.
/// @throws Error   Usage, before any work, if the outputs cannot be what was asked for.
int run(const CommandLine& command_line);

}  // namespace meshcontour::app

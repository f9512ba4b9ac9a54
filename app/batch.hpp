#pragma once

#include "command_line.hpp"

namespace meshcontour::app {

/// Runs the job of every input: one in this process, several (or one with a limit of time or memory) in
/// worker processes, so that a file that crashes, hangs or grows is one line in the summary while the rest go
/// on.
///
/// Results and messages are printed in the order of the inputs, whatever the number of workers.
///
/// @return         the exit code: 0 all good; the error's own code with one input, 1 with several.
/// @throws Error   Usage, before any work, if the outputs cannot be what was asked for; NoInput if a folder
/// holds no
///                 model; CannotCreate if a report or journal cannot be written.
int run(const CommandLine& command_line);

}  // namespace meshcontour::app

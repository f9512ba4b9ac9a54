#pragma once

#include <optional>
#include <string>
#include <vector>

#include "meshcontour/pipeline.hpp"

namespace meshcontour::app {

/// What the user asked for: a job a file is made from it.
struct CommandLine {
  std::vector<std::string> inputs;
  std::vector<std::string> outputs;   ///< templates with {stem} {dir} {n}
  std::vector<std::string> formats;   ///< of the outputs without a known extension, in order
  std::string report;                 ///< file for the times of the stages; empty: none
  Job job;                            ///< everything but input and outputs
  bool compare = false;
  int verbosity = 0;                  ///< -1 quiet, 0 warnings, 1 everything
};

/// Parses the arguments.
///
/// @return       nothing when --help or --version was answered on stdout.
/// @throws Error Usage, with the nearest known option where one is unknown.
std::optional<CommandLine> parse_command_line(int argc, const char* const* argv);

/// The job for one input: outputs with their templates filled in.
///
/// @param number  of the input, from 1.
/// @throws Error  Usage if an output has no known format or two inputs would write the same file.
Job make_job(const CommandLine& command_line, const std::string& input, std::size_t number);

}  // namespace meshcontour::app

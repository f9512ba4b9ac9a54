#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "meshcontour/pipeline.hpp"
#include "messages.hpp"

namespace meshcontour::app {

/// What the user asked for: a job a file is made from it.
struct CommandLine {
  std::vector<std::string> inputs;    ///< files and folders
  std::vector<std::string> outputs;   ///< templates with {stem} {dir} {n}
  std::vector<std::string> formats;   ///< of the outputs without a known extension, in order
  std::vector<std::string> meshes;    ///< templates too
  std::vector<std::string> wavelets;  ///< and these
  std::vector<View> views;            ///< of the pictures; the first is the job's
  std::vector<std::pair<ReportFormat, std::string>> reports;
  std::vector<std::string> pages;  ///< templates of pages of one input each
  Job job;                         ///< everything but input and outputs
  bool compare = false;
  unsigned repeat = 1;           ///< runs of each job, for stable times
  unsigned threads = 0;          ///< threads of one job, worker processes of several; 0: one per processor
  double timeout = 0;            ///< seconds a file; 0: none
  std::uint64_t max_memory = 0;  ///< bytes a file; 0: none
  std::string resume;            ///< journal of what is done; empty: none
  std::pair<std::size_t, std::size_t> shard{1, 1};  ///< number and count
  MessageStyle messages = MessageStyle::Text;
  int verbosity = 0;         ///< -1 quiet, 0 warnings, 1 everything
  std::string options_text;  ///< all arguments that are not inputs; two runs with the same make the same
};

/// Parses the arguments.
///
/// @return       nothing when --help or --version was answered on stdout.
/// @throws Error Usage, with the nearest known option where one is unknown.
std::optional<CommandLine> parse_command_line(int argc, const char* const* argv);

}  // namespace meshcontour::app

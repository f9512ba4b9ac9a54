#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "meshcontour/pipeline.hpp"

namespace meshcontour::app {

/// What the user asked for: a job a file is made from it.
struct CommandLine {
  std::vector<std::string> inputs;   ///< files and folders
  std::vector<std::string> outputs;  ///< templates with {stem} {dir} {n}
  std::vector<std::string> formats;  ///< of the outputs without a known extension, in order
  std::vector<std::string> meshes;   ///< templates too
  std::vector<std::string> wavelets;  ///< and these
  std::vector<std::pair<ReportFormat, std::string>> reports;
  std::vector<std::string> pages;    ///< templates of pages of one input each
  Job job;  ///< everything but input and outputs
  bool compare = false;
  unsigned repeat = 1;  ///< runs of each job, for stable times
  unsigned threads = 0;  ///< threads of one job, worker processes of several; 0: one per processor
  double timeout = 0;    ///< seconds a file; 0: none
  std::uint64_t max_memory = 0;                  ///< bytes a file; 0: none
  std::string resume;                            ///< journal of what is done; empty: none
  std::pair<std::size_t, std::size_t> shard{1, 1};  ///< number and count
  int verbosity = 0;                             ///< -1 quiet, 0 warnings, 1 everything
  std::string options_text;                      ///< all arguments that are not inputs; two runs with the same make the same
};

/// A job and the pages that the program itself writes about it.
struct FileJob : Job {
  std::vector<std::string> pages;
};

/// Parses the arguments.
///
/// @return       nothing when --help or --version was answered on stdout.
/// @throws Error Usage, with the nearest known option where one is unknown.
std::optional<CommandLine> parse_command_line(int argc, const char* const* argv);

/// The job for one input: outputs with their templates filled in.
///
/// @param number   of the input, from 1.
/// @param several  there are other inputs: the names of outputs must differ.
/// @throws Error   Usage if an output has no known format or its name no field that tells inputs apart.
FileJob make_job(const CommandLine& command_line, const std::string& input, std::size_t number, bool several);

/// Makes every stage of a job use that many threads; 0: one per processor.
void set_threads(Job& job, unsigned threads);

/// The paths of everything that a job writes.
std::vector<std::string> output_paths(const FileJob& job);

}  // namespace meshcontour::app

#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"
#include "meshcontour/pipeline.hpp"

namespace meshcontour::app {

/// A job and the pages that the program itself writes about it.
struct FileJob : Job {
  std::vector<std::string> pages;
};

/// The job for one input: outputs with their templates filled in, pictures once a view.
///
/// @param number   of the input, from 1.
/// @param several  there are other inputs: the names of outputs must differ.
/// @throws Error   Usage if an output has no known format or its name no field that tells inputs, or views,
/// apart.
FileJob make_job(const CommandLine& command_line, const std::string& input, std::size_t number, bool several);

/// Makes every stage of a job use that many threads; 0: one per processor.
void set_threads(Job& job, unsigned threads);

/// The paths of everything that a job writes.
std::vector<std::string> output_paths(const FileJob& job);

}  // namespace meshcontour::app

#pragma once

#include <string>

#include "file_job.hpp"
#include "meshcontour/report.hpp"

namespace meshcontour::app {

/// What came of one input: the record of the reports and what is to be printed.
struct Outcome {
  FileReport report;
  std::string output;  ///< for standard output
  std::string errors;  ///< for standard error, whole lines
};

/// Runs a job, as often as the command line says; failures are part of the outcome.
Outcome run_job(const FileJob& job, const CommandLine& line);

/// Makes the outcome a failure and adds the message to what is printed.
void fail(ErrorCode code, const std::string& message, const Spot& spot, const CommandLine& line,
          Outcome& outcome);

/// An outcome as bytes, to go from a worker to its parent, and back.
std::string to_bytes(const Outcome& outcome);
Outcome from_bytes(const std::string& bytes);

}  // namespace meshcontour::app

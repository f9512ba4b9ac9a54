#include "outcome.hpp"

#include <fmt/format.h>

#include <new>
#include <nlohmann/json.hpp>

#include "compare.hpp"

namespace meshcontour::app {
namespace {

void describe(const Run& run, const Job& job, const CommandLine& line, Outcome& outcome) {
  for (const Diagnostic& diagnostic : run.diagnostics) {
    const bool warning = diagnostic.severity == Diagnostic::Severity::Warning;
    if (line.verbosity >= (warning ? 0 : 1))
      outcome.errors += fmt::format("meshcontour: {}\n", diagnostic.text());
  }
  outcome.report.counts = counts_of(run.model, run.boundaries, run.contours);
  if (output_paths(job).empty() && line.reports.empty()) {
    outcome.output += summary(run.model, run.boundaries, run.contours, run.timings.stages(),
                              run.simplifications);
  }
}

void run_repeatedly(const Job& job, const CommandLine& line, Outcome& outcome) {
  for (unsigned repetition = 0; repetition < line.repeat; ++repetition) {
    const Run run = meshcontour::run(job);
    outcome.report.runs.push_back(run.timings.stages());
    if (repetition > 0) continue;
    describe(run, job, line, outcome);
    if (line.compare) compare(run.model, line, outcome);
  }
}

}  // namespace

void fail(ErrorCode code, const std::string& message, Outcome& outcome) {
  outcome.report.outcome = FileReport::Outcome::Failed;
  outcome.report.exit_code = static_cast<int>(code);
  outcome.report.message = message;
  outcome.errors += fmt::format("meshcontour: {}\n", message);
}

Outcome run_job(const Job& job, const CommandLine& line) {
  Outcome outcome;
  outcome.report.file = job.input;
  try {
    run_repeatedly(job, line, outcome);
  } catch (const Error& error) {
    const std::string input = error.spot().file.empty() ? printable(job.input) + ": " : "";
    fail(error.code(), input + error.what(), outcome);
  } catch (const std::bad_alloc&) {
    fail(ErrorCode::OutOfMemory, printable(job.input) + ": out of memory", outcome);
  } catch (const std::exception& error) {
    fail(ErrorCode::Internal, fmt::format("{}: internal error: {}", printable(job.input), error.what()),
         outcome);
  }
  outcome.report.peak_memory = peak_memory();
  return outcome;
}

std::string to_bytes(const Outcome& outcome) {
  const std::vector<std::uint8_t> bytes =
      nlohmann::json::to_cbor({to_record(outcome.report), outcome.output, outcome.errors});
  return {bytes.begin(), bytes.end()};
}

Outcome from_bytes(const std::string& bytes) {
  const nlohmann::json json = nlohmann::json::from_cbor(bytes);
  return {from_record(json.at(0).get<std::string>()), json.at(1), json.at(2)};
}

}  // namespace meshcontour::app

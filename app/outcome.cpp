#include "outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <nlohmann/json.hpp>

#include "compare.hpp"
#include "meshcontour/output.hpp"

namespace meshcontour::app {
namespace {

constexpr std::size_t kMostFindings = 100;  // listed on a page

void describe(const Run& run, const FileJob& job, const CommandLine& line, Outcome& outcome) {
  FileReport& report = outcome.report;
  for (const Diagnostic& diagnostic : run.diagnostics) {
    const bool warning = diagnostic.severity == Diagnostic::Severity::Warning;
    report.warnings += warning ? 1 : 0;
    if (report.findings.size() < kMostFindings) report.findings.push_back(diagnostic.text());
    if (line.verbosity >= (warning ? 0 : 1)) {
      outcome.errors += message_line(warning ? MessageKind::Warning : MessageKind::Notice, diagnostic.text(),
                                     diagnostic.spot, line.messages);
    }
  }
  if (run.diagnostics.size() > kMostFindings) {
    report.findings.push_back(fmt::format("and {} more", run.diagnostics.size() - kMostFindings));
  }
  for (const Contour& contour : run.contours)
    report.deviation = std::max(report.deviation, contour.deviation);
  report.preview = run.preview;
  report.counts = counts_of(run.model, run.boundaries, run.contours);
  if (output_paths(job).empty() && line.reports.empty()) {
    outcome.output +=
        summary(run.model, run.boundaries, run.contours, run.timings.stages(), run.simplifications);
  }
}

void run_repeatedly(const FileJob& job, const CommandLine& line, Outcome& outcome) {
  for (unsigned repetition = 0; repetition < line.repeat; ++repetition) {
    const Run run = meshcontour::run(job);
    outcome.report.runs.push_back(run.timings.stages());
    if (repetition > 0) continue;
    describe(run, job, line, outcome);
    if (line.compare) compare(run.model, line, outcome);
  }
}

// The pages of this input alone; opened before the work, so that one that cannot be written is found first.
class Pages {
 public:
  explicit Pages(const FileJob& job) {
    for (const std::string& page : job.pages) sinks_.push_back(&outputs_.open(page));
  }

  void write(const FileReport& report) {
    for (Sink* sink : sinks_) {
      write_report(ReportFormat::Html, {&report, 1}, this_machine(), start_, *sink);
    }
    outputs_.commit();
  }

 private:
  std::int64_t start_ = unix_time();
  OutputSet outputs_;
  std::vector<Sink*> sinks_;
};

}  // namespace

void fail(ErrorCode code, const std::string& message, const Spot& spot, const CommandLine& line,
          Outcome& outcome) {
  outcome.report.outcome = FileReport::Outcome::Failed;
  outcome.report.exit_code = static_cast<int>(code);
  outcome.report.message = message;
  outcome.errors += message_line(MessageKind::Error, message, spot, line.messages);
}

Outcome run_job(const FileJob& job, const CommandLine& line) {
  Outcome outcome;
  outcome.report.file = job.input;
  const Spot input{job.input, 0, 0, ""};
  try {
    Pages pages(job);
    run_repeatedly(job, line, outcome);
    outcome.report.peak_memory = peak_memory();
    pages.write(outcome.report);
    const auto is_page = [](const auto& report) { return report.first == ReportFormat::Html; };
    if (std::ranges::none_of(line.reports, is_page)) outcome.report.preview = {};
  } catch (const Error& error) {
    const bool placed = !error.spot().file.empty();
    const std::string prefix = placed ? "" : printable(job.input) + ": ";
    fail(error.code(), prefix + error.what(), placed ? error.spot() : input, line, outcome);
  } catch (const std::bad_alloc&) {
    fail(ErrorCode::OutOfMemory, printable(job.input) + ": out of memory", input, line, outcome);
  } catch (const std::exception& error) {
    fail(ErrorCode::Internal, fmt::format("{}: internal error: {}", printable(job.input), error.what()),
         input, line, outcome);
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

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "meshcontour/boundary.hpp"
#include "meshcontour/curve.hpp"
#include "meshcontour/output.hpp"
#include "meshcontour/simplification.hpp"

namespace meshcontour {

/// The time of one stage.
struct StageTime {
  std::string stage;
  double start_ms = 0;      ///< on the machine's steady clock, whose zero means nothing
  double wall_ms = 0;       ///< steady clock
  double cpu_ms = 0;        ///< of all threads of the process
  std::uint64_t items = 0;  ///< what the stage worked on; its unit is the stage's own
};

/// Collects the times of stages. The only place in the library that reads clocks.
class Timings {
 public:
  /// Runs the work and adds its time, also when it throws. A stage that is measured again adds to its first
  /// entry.
  template <typename Work>
  decltype(auto) measure(std::string_view stage, Work&& work) {
    const Running running(*this, stage);
    return std::forward<Work>(work)();
  }

  /// Sets the item count of a stage.
  void count(std::string_view stage, std::uint64_t items);

  /// In the order in which they were first measured.
  const std::vector<StageTime>& stages() const { return stages_; }

 private:
  class Running {
   public:
    Running(Timings& timings, std::string_view stage);
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    ~Running();

   private:
    Timings& timings_;
    std::size_t entry_;
    double wall_, cpu_;
  };

  std::size_t entry(std::string_view stage);

  std::vector<StageTime> stages_;
};

/// The largest resident memory of this process so far, bytes.
std::uint64_t peak_memory();

/// What a model and its contours consist of.
struct Counts {
  std::uint64_t shells = 0, instances = 0, patches = 0;
  std::uint64_t vertices = 0, triangles = 0;  ///< stored ones: a shell counts once however often it is placed
  std::uint64_t boundary_vertices = 0;        ///< each once a shell, however many patches share it
  std::uint64_t boundary_edges = 0;           ///< summed over the patches
  std::uint64_t loops = 0, open_chains = 0;   ///< open chains are among the loops
  std::uint64_t segments = 0;
  std::uint64_t lines = 0, arcs = 0, circles = 0, ellipses = 0,
                splines = 0;  ///< segments by kind; circles are full
};

Counts counts_of(const Model& model, std::span<const ShellBoundary> boundaries,
                 std::span<const Contour> contours);

/// Adds the segments of a contour to those of its kind.
void count_kinds(const Contour& contour, Counts& counts);

/// The table that is printed when no output is asked for: counts, the loops of each patch, the time of each
/// stage; and, where shells were simplified, how far. Of a model with many patches only those that stand out
/// are listed.
std::string summary(const Model& model, std::span<const ShellBoundary> boundaries,
                    std::span<const Contour> contours, std::span<const StageTime> timings,
                    std::span<const Simplification> simplifications = {});

/// What a page shows of a file besides texts and numbers.
struct Preview {
  std::string picture;           ///< a PNG in base64; empty: there is none
  std::string model;             ///< a GLB in base64; empty: too large, or left out
  std::uint64_t model_size = 0;  ///< bytes of the GLB; a lower bound when it is too large
};

/// Bytes of a GLB that a page still takes, and of all those on a page.
inline constexpr std::uint64_t kLargestPreviewModel = 3'000'000, kLargestPageModels = 32'000'000;

/// What became of one input of a run.
struct FileReport {
  enum class Outcome { Done, Failed, Skipped };

  std::string file;  ///< as it was named; reports leave out the folders of an absolute name
  Outcome outcome = Outcome::Done;
  int exit_code = 0;    ///< of the error; 128 + signal for a worker that died
  std::string message;  ///< why it failed or was skipped
  Counts counts;
  double deviation = 0;               ///< the largest of the contours, model units
  std::uint64_t warnings = 0;         ///< among the findings, the ones not listed too
  std::vector<std::string> findings;  ///< diagnostics, as text
  Preview preview;
  std::vector<std::vector<StageTime>> runs;  ///< the stages of each repetition
  std::uint64_t peak_memory = 0;             ///< bytes; 0: unknown
  unsigned worker = 0;                       ///< from 0
};

/// A report as one line of JSON without line break, and back: to pass it between processes and to keep it in
/// a journal.
std::string to_record(const FileReport& report);
/// @throws Error   BadData if the text is no whole record.
FileReport from_record(std::string_view text);

/// Where a report was made.
struct Machine {
  std::string host, system, cpu;
  unsigned cores = 1;               ///< that this process may use
  double mhz = 0;                   ///< 0: unknown
  bool cpu_scaling = false;         ///< the clock follows the load: timings vary
  std::array<double, 3> load = {};  ///< of the last 1, 5 and 15 minutes
};

Machine this_machine();

/// Seconds since 1970, UTC.
std::int64_t unix_time();

/// Reports that other programs read.
enum class ReportFormat {
  Json,  ///< our own, data/report.schema.json: one line a file; times are medians of the repetitions
  GoogleBenchmark,  ///< an iteration a stage and repetition, named STAGE/FILE; files that failed are left out
  JUnit,            ///< a test case a file
  GitHubAction,     ///< github-action-benchmark's customSmallerIsBetter: medians, FILE/STAGE
  Trace,            ///< Chrome trace events: a row a worker
  Html,             ///< a page for people, self-contained, with the previews
};

/// json, gbench, junit, gha, trace or html.
std::optional<ReportFormat> report_format(std::string_view name);
std::span<const std::string_view> report_format_names();

/// Writes the report of all files of a run.
///
/// @param time     when the run began, seconds since 1970.
/// @throws Error   InputOutput from the sink.
void write_report(ReportFormat format, std::span<const FileReport> files, const Machine& machine,
                  std::int64_t time, Sink& sink);

}  // namespace meshcontour

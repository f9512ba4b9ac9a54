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
};

Counts counts_of(const Model& model, std::span<const ShellBoundary> boundaries,
                 std::span<const Contour> contours);

/// The table that is printed when no output is asked for: counts, the loops of each patch, the time of each
/// stage. Of a model with many patches only those that stand out are listed.
std::string summary(const Model& model, std::span<const ShellBoundary> boundaries,
                    std::span<const Contour> contours, std::span<const StageTime> timings);

}  // namespace meshcontour

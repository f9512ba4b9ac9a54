#include "fit/model_recognition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/arc_fit.hpp"
#include "fit/cleaning.hpp"
#include "fit/closed_conics.hpp"
#include "fit/end_tangents.hpp"
#include "fit/gather_evidence.hpp"
#include "fit/loop.hpp"
#include "meshcontour/parallel.hpp"

namespace meshcontour::detail {

namespace {

constexpr std::size_t kChainsPerTask = 16;
constexpr double kDefaultTolerance = 1e-4;  // of a loop's box diagonal
constexpr double kCoarsestSagitta = 0.005;  // of a shell's box diagonal
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Task {
  std::size_t shell, chain;
};

std::vector<Point> points_of(const Shell& shell, const EdgeChain& chain) {
  std::vector<Point> points;
  points.reserve(chain.vertices.size());
  for (const Index v : chain.vertices) points.push_back(shell.points[v]);
  return points;
}

double diagonal_of(const Shell& shell, const BoundaryLoop& loop) {
  Box box;
  for (const Index v : loop.vertices) box.extend(shell.points[v]);
  return loop.vertices.empty() ? 0 : box.diagonal().stableNorm();
}

// The passes over a model's chains.
class ModelRecognizer {
 public:
  ModelRecognizer(const Model& model, std::span<const ShellBoundary> boundaries, const FitOptions& options)
      : model_(model), boundaries_(boundaries), options_(options) {
    shells_.resize(boundaries.size());
    settings_.resize(boundaries.size());
  }

  std::vector<ShellRecognition> run() {
    parallel_for(shells_.size(), 1, options_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s) prepare_shell(s);
    });
    for (std::size_t s = 0; s < shells_.size(); ++s) {
      for (std::size_t c = 0; c < shells_[s].chains.chains.size(); ++c) tasks_.push_back({s, c});
    }
    recognize_all(false);
    if (options_.method == FitMethod::Primitives) {
      find_conics();
      evidence_ = gather_evidence(shells_);
      recognize_all(true);
      find_conics();
    }
    make_tangent();
    return std::move(shells_);
  }

 private:
  void prepare_shell(std::size_t s) {
    const Shell& shell = model_.shells[s];
    ShellRecognition& result = shells_[s];
    result.chains = find_edge_chains(shell, boundaries_[s]);
    result.fits.resize(result.chains.chains.size());
    RecognitionOptions common;
    common.corner_angle = options_.corner_angle;
    common.noise = 2 * coordinate_quantum(shell);
    common.coarsest = kCoarsestSagitta * bounding_box(shell).diagonal().stableNorm();
    common.primitives = options_.method == FitMethod::Primitives;
    common.shell = s;
    settings_[s].assign(result.fits.size(), common);
    for (RecognitionOptions& chain : settings_[s]) chain.tolerance = kInfinity;
    for (std::size_t p = 0; p < boundaries_[s].patches.size(); ++p) {
      const SharedArray<BoundaryLoop>& loops = boundaries_[s].patches[p].loops;
      for (std::size_t l = 0; l < loops.size(); ++l) {
        const double diagonal = diagonal_of(shell, loops[l]);
        if (!is_usable_size(diagonal)) continue;
        const double tolerance = options_.tolerance > 0 ? options_.tolerance : kDefaultTolerance * diagonal;
        for (const ChainUse& use : result.chains.uses[p][l]) {
          RecognitionOptions& chain = settings_[s][use.chain];
          chain.tolerance = std::min(chain.tolerance, tolerance);
          chain.bounded = result.chains.chains[use.chain].shared && !result.chains.chains[use.chain].closed;
        }
      }
    }
  }

  void recognize_all(bool again) {
    parallel_for(tasks_.size(), kChainsPerTask, options_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) recognize_one(tasks_[t], again);
    });
  }

  void recognize_one(const Task& task, bool again) {
    ShellRecognition& shell = shells_[task.shell];
    Recognition& fit = shell.fits[task.chain];
    RecognitionOptions settings = settings_[task.shell][task.chain];
    if (!(settings.tolerance > 0 && settings.tolerance < kInfinity)) return;
    if (again) {
      settings.evidence = &evidence_;
      if (!may_change(fit, settings)) return;
    }
    const EdgeChain& chain = shell.chains.chains[task.chain];
    fit = recognize(make_path(points_of(model_.shells[task.shell], chain), chain.closed), settings);
  }

  void find_conics() {
    parallel_for(shells_.size(), 1, options_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s) {
        find_closed_conics(model_.shells[s], boundaries_[s], settings_[s], shells_[s]);
      }
    });
  }

  void make_tangent() {
    parallel_for(shells_.size(), 1, options_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s)
        make_splines_tangent(settings_[s], shells_[s], options_.threads);
    });
  }

  const Model& model_;
  std::span<const ShellBoundary> boundaries_;
  const FitOptions& options_;
  std::vector<ShellRecognition> shells_;
  std::vector<std::vector<RecognitionOptions>> settings_;  // by shell and chain
  std::vector<Task> tasks_;
  ModelEvidence evidence_;
};

}  // namespace

std::vector<ShellRecognition> recognize_model(const Model& model, std::span<const ShellBoundary> boundaries,
                                              const FitOptions& options) {
  return ModelRecognizer(model, boundaries, options).run();
}

}  // namespace meshcontour::detail

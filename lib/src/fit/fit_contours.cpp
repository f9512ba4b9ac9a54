#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/certificate.hpp"
#include "fit/chain_contours.hpp"
#include "fit/loop.hpp"
#include "fit/whole_loop.hpp"
#include "meshcontour/fit.hpp"
#include "meshcontour/parallel.hpp"

namespace meshcontour {
namespace {

constexpr std::size_t kLoopsPerTask = 8;
constexpr std::size_t kThreadedPoints =
    4096;  // in all loops; to fit fewer takes no longer than to start threads

struct Task {
  std::size_t shell, patch, loop;
};

void check(const FitOptions& options) {
  if (!std::isfinite(options.tolerance) || options.tolerance < 0) {
    throw Error(ErrorCode::Usage,
                fmt::format("the fit tolerance {} is not a positive length", options.tolerance));
  }
  if (!(options.corner_angle > 0 && options.corner_angle <= std::numbers::pi)) {
    throw Error(ErrorCode::Usage, fmt::format("the corner angle {} is not in (0, 180] degrees",
                                              options.corner_angle * 180 / std::numbers::pi));
  }
}

std::vector<Task> list_tasks(std::span<const ShellBoundary> boundaries) {
  std::vector<Task> tasks;
  for (std::size_t shell = 0; shell < boundaries.size(); ++shell) {
    for (std::size_t patch = 0; patch < boundaries[shell].patches.size(); ++patch) {
      const std::size_t loops = boundaries[shell].patches[patch].loops.size();
      for (std::size_t loop = 0; loop < loops; ++loop) tasks.push_back({shell, patch, loop});
    }
  }
  return tasks;
}

std::size_t point_count(std::span<const ShellBoundary> boundaries) {
  std::size_t count = 0;
  for (const ShellBoundary& boundary : boundaries) {
    for (const PatchBoundary& patch : boundary.patches) {
      for (const BoundaryLoop& loop : patch.loops) count += loop.vertices.size();
    }
  }
  return count;
}

detail::ParametrizedCurve whole_curve(const detail::Loop& loop, FitMethod method) {
  const std::vector<Point>& points = loop.cleaned.points;
  if (method == FitMethod::Control) {
    return loop.closed ? detail::closed_control_curve(points) : detail::open_control_curve(points);
  }
  return loop.closed ? detail::closed_interpolation(points) : detail::open_interpolation(points);
}

Contour whole_contour(const detail::Loop& loop, FitMethod method) {
  detail::ParametrizedCurve fitted = whole_curve(loop, method);
  Contour contour;
  contour.closed = loop.closed;
  contour.deviation =
      detail::spline_deviation(fitted.curve, loop.cleaned.points, fitted.parameters, loop.closed) +
      loop.cleaned.dropped;
  if (!std::isfinite(contour.deviation)) return detail::polygon_contour(loop);
  Segment segment;
  segment.from = loop.vertices.front();
  segment.to = loop.closed ? segment.from : loop.vertices.back();
  segment.curve = std::move(fitted.curve);
  segment.deviation = contour.deviation;
  contour.segments.push_back(std::move(segment));
  return contour;
}

// One line a kind of defect, at its first loop.
class DefectList {
 public:
  void add(detail::LoopDefect defect, const Model& model, const Task& task) {
    Diagnostic& diagnostic = found_[static_cast<std::size_t>(defect)];
    if (!diagnostic.message.empty()) {
      ++diagnostic.count;
      return;
    }
    diagnostic.message = text(defect);
    diagnostic.spot.element = fmt::format(
        "shell {}, patch {}, loop {}", printable(model.shells[task.shell].id), task.patch + 1, task.loop + 1);
  }

  void append_to(std::vector<Diagnostic>& diagnostics) const {
    for (const Diagnostic& d : found_) {
      if (!d.message.empty()) diagnostics.push_back(d);
    }
  }

 private:
  static const char* text(detail::LoopDefect defect) {
    switch (defect) {
      case detail::LoopDefect::TooFewPoints:
        return "a loop with fewer than 3 distinct points is kept as its polygon";
      case detail::LoopDefect::OutOfRange:
        return "a loop too large or too small to be fitted is kept as its polygon";
      default:
        return "a loop that cannot be fitted is kept as its polygon";
    }
  }

  std::array<Diagnostic, 3> found_;
};

}  // namespace

std::vector<Contour> fit_contours(const Model& model, std::span<const ShellBoundary> boundaries,
                                  const FitOptions& chosen, std::vector<Diagnostic>& diagnostics) {
  check(chosen);
  FitOptions options = chosen;
  if (point_count(boundaries) < kThreadedPoints) options.threads = 1;
  const std::vector<Task> tasks = list_tasks(boundaries);
  const bool by_chains = options.method == FitMethod::Approximate || options.method == FitMethod::Primitives;
  std::vector<Contour> contours(tasks.size());
  if (by_chains) contours = detail::chain_contours(model, boundaries, options);
  std::vector<detail::LoopDefect> defects(tasks.size(), detail::LoopDefect::None);
  parallel_for(tasks.size(), kLoopsPerTask, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Task& task = tasks[i];
      const BoundaryLoop& boundary = boundaries[task.shell].patches[task.patch].loops[task.loop];
      const detail::Loop loop = detail::make_loop(model.shells[task.shell].points, boundary);
      defects[i] = detail::find_defect(loop);
      bool sound = defects[i] == detail::LoopDefect::None;
      if (sound && by_chains) sound = !contours[i].segments.empty() && std::isfinite(contours[i].deviation);
      if (sound && !by_chains) contours[i] = whole_contour(loop, options.method);
      if (!sound) contours[i] = detail::polygon_contour(loop);
      contours[i].shell = task.shell;
      contours[i].patch = task.patch;
      contours[i].loop = task.loop;
    }
  });
  DefectList found;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (contours[i].fallback) found.add(defects[i], model, tasks[i]);
  }
  found.append_to(diagnostics);
  return contours;
}

}  // namespace meshcontour

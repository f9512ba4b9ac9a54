#include "pipeline/simplification_report.hpp"

#include <fmt/format.h>

namespace meshcontour::detail {
namespace {

Spot spot_of(const Model& model, const Simplification& simplification) {
  Spot spot;
  spot.element = fmt::format("shell {}", printable(model.shells[simplification.shell].id));
  return spot;
}

std::string method_name(const Simplification& simplification) {
  if (simplification.method == SimplifyMethod::Qem) return "edge collapses";
  return fmt::format("wavelets on {} levels", simplification.levels);
}

std::string remesh_of(const Simplification& simplification) {
  if (simplification.remesh_triangles == 0) return {};
  return fmt::format("; remeshed to {} triangles before, at most {} apart", simplification.remesh_triangles,
                     simplification.remesh_error);
}

}  // namespace

void report_simplifications(const SimplifyOptions& options, std::span<const Simplification> simplifications,
                            Model& model) {
  std::size_t before = 0, after = 0;
  for (const Simplification& s : simplifications) {
    before += s.triangles_before;
    after += s.triangles_after;
    if (s.triangles_before == 0) continue;
    model.diagnostics.push_back(
        {Diagnostic::Severity::Note,
         fmt::format("simplified from {} to {} triangles by {}, at most {} apart{}", s.triangles_before,
                     s.triangles_after, method_name(s), s.error, remesh_of(s)),
         spot_of(model, s)});
  }
  if (options.goal == SimplifyGoal::Error || simplifications.empty()) return;
  const double wanted =
      options.goal == SimplifyGoal::Ratio ? options.value * static_cast<double>(before) : options.value;
  // Collapses take two triangles at a time, and every shell is rounded by itself.
  if (static_cast<double>(after) <= wanted + 2 * static_cast<double>(simplifications.size())) return;
  model.diagnostics.push_back(
      {Diagnostic::Severity::Warning,
       fmt::format("simplified to {} triangles instead of {:.0f}: borders, patches and topology need them",
                   after, wanted),
       {}});
}

}  // namespace meshcontour::detail

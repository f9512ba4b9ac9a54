#include "meshcontour/units.hpp"

#include <algorithm>
#include <cmath>

namespace meshcontour {

std::optional<double> metres_of(std::string_view symbol) {
  const auto found = std::ranges::find(kLengthUnits, symbol, &LengthUnit::symbol);
  return found == kLengthUnits.end() ? std::nullopt : std::optional(found->metres);
}

std::string_view unit_symbol(double metres_per_unit) {
  const auto is_it = [&](const LengthUnit& unit) {
    return std::abs(unit.metres - metres_per_unit) <= 1e-9 * unit.metres;
  };
  const auto found = std::ranges::find_if(kLengthUnits, is_it);
  return found == kLengthUnits.end() ? std::string_view() : found->symbol;
}

void convert_units(Model& model, double metres_per_unit) {
  if (!(model.metres_per_unit > 0)) {
    throw Error(ErrorCode::Usage, "the model does not tell its unit: name it with --input-unit");
  }
  const double factor = model.metres_per_unit / metres_per_unit;
  model.metres_per_unit = metres_per_unit;
  if (factor == 1) return;
  const Eigen::Affine3d scaling(Eigen::UniformScaling<double>{factor});
  for (Shell& shell : model.shells) {
    for (Point& p : shell.points) p *= factor;
    for (double& size : shell.details) size *= factor;
  }
  for (Instance& instance : model.instances) instance.placement.translation() *= factor;
  for (std::vector<Polyline>* lines : {&model.annotations, &model.tree, &model.path}) {
    for (Polyline& line : *lines) {
      for (Point& p : line.points) p *= factor;
    }
  }
  for (NamedCurve& named : model.curves) {
    named.curve = transformed(named.curve, scaling);
    for (CurveFrame& frame : named.frames) frame.position *= factor;
  }
}

}  // namespace meshcontour

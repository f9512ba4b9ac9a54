#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "meshcontour/model.hpp"

namespace meshcontour {

/// A unit of length by the symbol that files, options and pictures use.
struct LengthUnit {
  std::string_view symbol;
  double metres;
};

inline constexpr std::array<LengthUnit, 10> kLengthUnits = {{{"nm", 1e-9},
                                                             {"um", 1e-6},
                                                             {"mm", 1e-3},
                                                             {"cm", 1e-2},
                                                             {"dm", 1e-1},
                                                             {"m", 1},
                                                             {"km", 1e3},
                                                             {"in", 0.0254},
                                                             {"ft", 0.3048},
                                                             {"mil", 2.54e-5}}};

/// The metres of a symbol; nothing if it is none of these.
std::optional<double> metres_of(std::string_view symbol);

/// The symbol of a unit; empty for one without, or of 0 metres.
std::string_view unit_symbol(double metres_per_unit);

/// Gives all lengths of a model in another unit: points, placements, curves and lines.
///
/// @param metres_per_unit  of the new unit, positive.
/// @throws Error           Usage if the model does not tell its unit.
void convert_units(Model& model, double metres_per_unit);

}  // namespace meshcontour

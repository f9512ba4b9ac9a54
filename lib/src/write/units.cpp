#include "write/units.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace meshcontour::detail {
namespace {

struct Unit {
  double metres;
  std::string_view name;
  std::string_view si_prefix;
  int dxf;
};

constexpr std::array<Unit, 14> kUnits = {{{1e-3, "MILLIMETRE", ".MILLI.", 4},
                                          {1, "METRE", "$", 6},
                                          {0.0254, "INCH", "", 1},
                                          {0.3048, "FOOT", "", 2},
                                          {1e-2, "CENTIMETRE", ".CENTI.", 5},
                                          {1e-1, "DECIMETRE", ".DECI.", 14},
                                          {1e-6, "MICROMETRE", ".MICRO.", 13},
                                          {1e-9, "NANOMETRE", ".NANO.", 12},
                                          {1e3, "KILOMETRE", ".KILO.", 7},
                                          {2.54e-5, "MIL", "", 9},
                                          {2.54e-8, "MICROINCH", "", 8},
                                          {0.9144, "YARD", "", 10},
                                          {1609.344, "MILE", "", 3},
                                          {1e-10, "ANGSTROM", "", 11}}};

constexpr Unit kOther = {0, "UNIT", "", 0};

const Unit& unit_of(double metres) {
  for (const Unit& unit : kUnits) {
    if (std::abs(metres - unit.metres) <= 1e-9 * unit.metres) return unit;
  }
  return kOther;
}

}  // namespace

std::string_view si_prefix(double metres_per_unit) {
  return unit_of(metres_per_unit).si_prefix;
}

std::string_view unit_name(double metres_per_unit) {
  return unit_of(metres_per_unit).name;
}

int dxf_unit(double metres_per_unit) {
  return unit_of(metres_per_unit).dxf;
}

void note_unit(std::string_view format, double metres_per_unit, std::string_view assumed,
               std::vector<Diagnostic>& notes) {
  const std::string reason = metres_per_unit > 0
                                 ? fmt::format("has no name for a unit of {} m", metres_per_unit)
                                 : "the model does not tell its unit";
  notes.push_back(
      {Diagnostic::Severity::Note, fmt::format("{}: {}, written as {}", format, reason, assumed), {}});
}

}  // namespace meshcontour::detail

#pragma once

#include <string_view>
#include <vector>

#include "meshcontour/error.hpp"

namespace meshcontour::detail {

/// STEP's prefix of the metre, "$" for the metre itself; empty if the unit is no decimal one.
std::string_view si_prefix(double metres_per_unit);

/// INCH, FOOT, ...; UNIT for one without a name.
std::string_view unit_name(double metres_per_unit);

/// DXF's $INSUNITS; 0 for a unit that it does not know.
int dxf_unit(double metres_per_unit);

/// A note that the model does not tell its unit, or that the format has no name for it, and what the file
/// says instead.
void note_unit(std::string_view format, double metres_per_unit, std::string_view assumed,
               std::vector<Diagnostic>& notes);

}  // namespace meshcontour::detail

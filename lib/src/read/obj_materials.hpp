#pragma once

#include <map>
#include <string>

#include "base/input_file.hpp"
#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// Adds the diffuse colours (Kd, with opacity d or Tr) of a material library to `colors`, by the material's
/// name.
///
/// @throws Error  if the file cannot be opened, or BadData if a number is wrong.
void read_obj_materials(const InputFolder& folder, std::string_view file,
                        std::map<std::string, Rgba>& colors);

}  // namespace meshcontour::detail

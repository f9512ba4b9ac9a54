#include "meshcontour/version.hpp"

namespace meshcontour {

std::string_view version() {
  return MESHCONTOUR_VERSION;
}

std::string_view libraries() {
  return MESHCONTOUR_LIBRARIES;
}

}  // namespace meshcontour

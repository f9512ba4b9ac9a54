#include "meshcontour/version.hpp"

namespace meshcontour {

std::string_view version() {
  return MESHCONTOUR_VERSION;
}

}  // namespace meshcontour

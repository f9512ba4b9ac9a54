#pragma once

// Optional models that live beside the checkout. A test that uses them starts with MESHCONTOUR_NEEDS_SHARED.

#include <filesystem>

#include "support/catch.hpp"
#include "support/paths.hpp"

inline std::filesystem::path shared_dir() {
  return MESHCONTOUR_SHARED_DIR;
}

#define MESHCONTOUR_NEEDS_SHARED(part)                                   \
  if (!std::filesystem::exists(shared_dir() / part)) {                   \
    WARN("skipped: " << (shared_dir() / part).string() << " is absent"); \
    return;                                                              \
  }

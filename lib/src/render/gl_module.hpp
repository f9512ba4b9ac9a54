#pragma once

#include <string>
#include <vector>

#include "render/gl_api.hpp"

namespace meshcontour::detail {

/// The drawing module of a backend, loaded on first use and kept.
///
/// Looked for in the directory that MESHCONTOUR_GL_MODULES names; else in lib/meshcontour beside the program
/// or up to four folders above it, which holds for the build tree and after installation. There only files of
/// root or of the program's owner are loaded.
///
/// @param failure  why there is none, with the package that is missing; appended to.
/// @return         null if there is none.
const GlApi* load_gl_module(GlBackend backend, std::string& failure);

/// The backends to try, in this order.
std::vector<GlBackend> backends(GlBackend wanted);

const char* backend_name(GlBackend backend);

}  // namespace meshcontour::detail

#pragma once

// The files of html/, embedded by html/embed.cmake.

#include <string_view>

namespace meshcontour::detail {

extern const std::string_view kPageCss, kPageJs, kViewerJs;

}  // namespace meshcontour::detail

#pragma once

#include "read/format.hpp"

namespace meshcontour::detail {

Match sniff_net(std::string_view head, std::uint64_t size);

/// Reads a `.net` control mesh: lines with the keywords BaseTexture, GlossTexture, EnvTexture, v, t, c and f.
/// One smooth surface, so that it has one patch; faces become fans of triangles from their first corners.
Model read_net(std::string_view bytes, const ReadContext& context);

}  // namespace meshcontour::detail

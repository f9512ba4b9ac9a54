#pragma once

#include "read/format.hpp"

namespace meshcontour::detail {

/// PLY, text or binary of either byte order, with any elements and properties. Faces that carry a whole
/// number named patch, face_id, region, group, label, material or the like make patches, one a number; else
/// faces of more than one colour make patches, one a colour. Triangle strips are read, vertex normals and
/// colours are not.
Match sniff_ply(std::string_view head, std::uint64_t size);
Model read_ply(std::string_view bytes, const ReadContext& context);

}  // namespace meshcontour::detail

#pragma once

#include "read/format.hpp"

namespace meshcontour::detail {

/// Wavefront OBJ: vertices, normals and faces of any size; indices from the front or, negative, from the
/// back. The combinations of object, group and material that faces stand under are patches, in the colours of
/// the material library when it lies in the folder of the file. Lines, points, texture and free-form geometry
/// are left out.
Match sniff_obj(std::string_view head, std::uint64_t size);
Model read_obj(std::string_view bytes, const ReadContext& context);

}  // namespace meshcontour::detail

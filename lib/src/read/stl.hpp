#pragma once

#include "read/format.hpp"

namespace meshcontour::detail {

/// STL, binary or text. Corners with equal coordinates become one point, numbered by first appearance. The
/// solids of a text file with several are patches. The file's normals are not used. A binary file whose
/// header says "solid" is told by its size.
Match sniff_stl(std::string_view head, std::uint64_t size);
Model read_stl(std::string_view bytes, const ReadContext& context);
/// Binary files part by part.
Model read_stl_file(InputFile& file, const ReadContext& context);

}  // namespace meshcontour::detail

#pragma once

#include "read/format.hpp"

namespace meshcontour::detail {

/// Sure for anything that begins as XML does, in UTF-8 or UTF-16.
Match sniff_webxml(std::string_view head, std::uint64_t size);

/// Reads a model in the webxml form of STEP tools: a step-assembly with its products, shapes, shells and
/// annotations, or a shell or annotation by itself. Shells and annotations in files of their own (href) are
/// read from the context's folder, each file once, and may not name further files.
///
/// @throws Error  BadData with file, line and element; OutOfMemory if the assembly is beyond a limit, before
/// it is
///                placed; NoInput never: parts whose file is missing are left out with one warning.
Model read_webxml(std::string_view bytes, const ReadContext& context);

/// The same for a regular file, of which only the part at hand is kept in memory.
Model read_webxml_file(InputFile& file, const ReadContext& context);

/// The same with every body parsed by tinyxml2, for comparison.
Model read_webxml_carefully(std::string_view bytes, const ReadContext& context);

}  // namespace meshcontour::detail

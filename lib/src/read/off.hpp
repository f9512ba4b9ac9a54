#pragma once

#include "read/format.hpp"

namespace meshcontour::detail {

/// OFF in text, with any of the prefixes ST, C and N, whose numbers are skipped; comments from '#'. Faces of
/// more than one colour make patches, one a colour.
Match sniff_off(std::string_view head, std::uint64_t size);
Model read_off(std::string_view bytes, const ReadContext& context);

}  // namespace meshcontour::detail

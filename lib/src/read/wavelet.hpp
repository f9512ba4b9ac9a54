#pragma once

#include "read/format.hpp"

namespace meshcontour::detail {

/// Progressive wavelet streams, whole or cut off, see wavelet_stream.hpp.
Match sniff_wavelet(std::string_view head, std::uint64_t size);
Model read_wavelet(std::string_view bytes, const ReadContext& context);

}  // namespace meshcontour::detail

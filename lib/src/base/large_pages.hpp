#pragma once

#include <cstddef>

namespace meshcontour::detail {

/// Size and alignment of the large pages of most processors.
inline constexpr std::size_t kLargePage = std::size_t{2} << 20;

/// Asks for large pages for memory that is about to be filled: fewer page faults. Has no other effect.
void advise_large_pages(void* data, std::size_t size);

}  // namespace meshcontour::detail

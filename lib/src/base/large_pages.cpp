#include "base/large_pages.hpp"

#include <sys/mman.h>

#include <cstdint>

namespace meshcontour::detail {

void advise_large_pages(void* data, std::size_t size) {
  const auto address = reinterpret_cast<std::uintptr_t>(data);
  const auto begin = (address + kLargePage - 1) / kLargePage * kLargePage;
  const auto end = (address + size) / kLargePage * kLargePage;
  if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

}  // namespace meshcontour::detail

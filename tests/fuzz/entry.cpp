// What libFuzzer calls; the target is chosen when this is compiled.

#include <cstddef>
#include <cstdint>

#include "fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Target target = fuzz::find_target(MESHCONTOUR_FUZZ_TARGET);
  target({data, size});
  return 0;
}

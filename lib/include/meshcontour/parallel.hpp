#pragma once

#include <cstddef>
#include <functional>

namespace meshcontour {

/// Calls body(begin, end) for parts that together cover 0..count, on at most `threads` threads.
///
/// The parts depend on `count` and `grain` alone, never on the threads; a body that writes only to slots of
/// its own range gives the same result for every thread count.
///
/// @param threads  0: one per processor; 1: runs in the caller.
/// @param grain    largest part, at least 1.
/// @throws         what a body throws.
void parallel_for(std::size_t count, std::size_t grain, unsigned threads,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace meshcontour

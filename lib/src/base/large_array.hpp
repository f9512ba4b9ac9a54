#pragma once

#include <cstddef>
#include <vector>

#include "base/input_file.hpp"

namespace meshcontour::detail {

/// Room for elements in large pages: filling an array of millions in small ones costs more in page faults than the
/// work on it.
template <typename Element>
void reserve_large(std::vector<Element>& elements, std::size_t count) {
  elements.reserve(count);
  advise_huge_pages(elements.data(), elements.capacity() * sizeof(Element));
}

/// The same, filled with a value.
template <typename Element>
void assign_large(std::vector<Element>& elements, std::size_t count, const Element& value) {
  elements.clear();
  reserve_large(elements, count);
  elements.assign(count, value);
}

}  // namespace meshcontour::detail

#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "base/large_pages.hpp"

namespace meshcontour::detail {

/// Room for elements in large pages: filling an array of millions in small ones costs more in page faults
/// than the work on it.
template <typename Element>
void reserve_large(std::vector<Element>& elements, std::size_t count) {
  elements.reserve(count);
  advise_large_pages(elements.data(), elements.capacity() * sizeof(Element));
}

/// The same, filled with a value.
template <typename Element>
void assign_large(std::vector<Element>& elements, std::size_t count, const Element& value) {
  elements.clear();
  reserve_large(elements, count);
  elements.assign(count, value);
}

/// Bytes that are zero without being touched; in large pages where they are many.
class ZeroedMemory {
 public:
  ZeroedMemory() = default;
  explicit ZeroedMemory(std::size_t size) {
    if (size < 2 * kLargePage) {
      data_ = std::calloc(size, 1);
      if (data_ == nullptr) throw std::bad_alloc();
      return;
    }
    mapped_ = (size / kLargePage + 2) * kLargePage;
    void* pages = ::mmap(nullptr, mapped_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED) throw std::bad_alloc();
    pages_ = data_ = pages;
    std::size_t room = mapped_;
    std::align(kLargePage, size, data_, room);
    advise_large_pages(pages_, mapped_);
  }
  ZeroedMemory(ZeroedMemory&& other) noexcept { swap(other); }
  ZeroedMemory& operator=(ZeroedMemory&& other) noexcept {
    swap(other);
    return *this;
  }
  ~ZeroedMemory() {
    if (pages_ != nullptr) {
      ::munmap(pages_, mapped_);
    } else {
      std::free(data_);
    }
  }

  void* data() const { return data_; }

 private:
  void swap(ZeroedMemory& other) {
    std::swap(data_, other.data_);
    std::swap(pages_, other.pages_);
    std::swap(mapped_, other.mapped_);
  }

  void* data_ = nullptr;
  void* pages_ = nullptr;  // if they are mapped
  std::size_t mapped_ = 0;
};

}  // namespace meshcontour::detail

#pragma once

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <vector>

#include "base/large_pages.hpp"
#include "meshcontour/shared_array.hpp"

namespace meshcontour::detail {

/// Makes arrays, short ones as parts of common blocks: a call of malloc for each, and above all the page
/// faults of memory in small pieces, cost more than the boundary of a small patch.
template <class Element>
class ArrayBlocks {
 public:
  /// An array of these elements, which are moved.
  SharedArray<Element> make(std::span<Element> elements) {
    if (elements.size() > kShort) {
      return std::vector<Element>(std::make_move_iterator(elements.begin()),
                                  std::make_move_iterator(elements.end()));
    }
    if (!block_ || block_->room() < elements.size()) {
      block_ = std::make_shared<Block>(bytes_);
      bytes_ = std::min(8 * bytes_, kLargestBlock);
    }
    return {block_, block_->append(elements)};
  }

 private:
  static constexpr std::size_t kShort = 128;
  static constexpr std::size_t kFirstBlock = std::size_t{4} << 10;
  static constexpr std::size_t kLargestBlock = std::size_t{8} << 20;
  static_assert(kShort * sizeof(Element) <= kFirstBlock);

  class Block {
   public:
    explicit Block(std::size_t bytes) : capacity_(bytes / sizeof(Element)) {
      data_ = static_cast<Element*>(std::aligned_alloc(bytes < kLargePage ? kFirstBlock : kLargePage, bytes));
      if (data_ == nullptr) throw std::bad_alloc();
      advise_large_pages(data_, bytes);
    }
    Block(const Block&) = delete;
    Block& operator=(const Block&) = delete;
    ~Block() {
      std::destroy_n(data_, size_);
      std::free(data_);
    }

    std::size_t room() const { return capacity_ - size_; }

    std::span<const Element> append(std::span<Element> elements) {
      Element* first = data_ + size_;
      std::uninitialized_move(elements.begin(), elements.end(), first);
      size_ += elements.size();
      return {first, elements.size()};
    }

   private:
    Element* data_;
    std::size_t size_ = 0, capacity_;
  };

  std::shared_ptr<Block> block_;
  std::size_t bytes_ = kFirstBlock;
};

}  // namespace meshcontour::detail

#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace meshcontour {

/// An array that cannot be changed and whose copies share its memory.
///
/// Many short arrays may be parts of one block, which stays until the last of them is gone.
template <class Element>
class SharedArray {
 public:
  using value_type = Element;
  using const_iterator = const Element*;
  using iterator = const_iterator;

  SharedArray() = default;

  SharedArray(std::vector<Element> elements) {  // NOLINT(google-explicit-constructor): a vector is one, too
    if (elements.empty()) return;
    const auto owner = std::make_shared<const std::vector<Element>>(std::move(elements));
    *this = SharedArray(owner, *owner);
  }

  SharedArray(std::initializer_list<Element> elements) : SharedArray(std::vector<Element>(elements)) {}

  /// Elements that live as long as their owner.
  SharedArray(const std::shared_ptr<const void>& owner, std::span<const Element> elements)
      : data_(owner, elements.data()), size_(elements.size()) {}

  const_iterator begin() const { return data(); }
  const_iterator end() const { return data() + size_; }
  const Element* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const Element& operator[](std::size_t i) const { return data()[i]; }
  const Element& front() const { return data()[0]; }
  const Element& back() const { return data()[size_ - 1]; }

  friend bool operator==(const SharedArray& a, const SharedArray& b) { return std::ranges::equal(a, b); }

 private:
  std::shared_ptr<const Element> data_;
  std::size_t size_ = 0;
};

}  // namespace meshcontour

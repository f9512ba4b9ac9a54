#pragma once

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_file.hpp"

namespace meshcontour::detail {

/// The bytes of an input by position: of a text in memory, or of a file of which only the parts at hand are
/// held. What is looked at is a copy, so that a file that changes meanwhile gives other bytes and no more.
class TextSource {
 public:
  explicit TextSource(std::string_view text) : text_(text), size_(text.size()) {}
  /// @param file  a regular file; must outlive the source.
  explicit TextSource(const InputFile& file) : file_(&file), size_(file.size()) {}

  std::size_t size() const { return size_; }
  /// Leaves out what is behind.
  void cut(std::size_t size) { size_ = std::min(size_, size); }

  /// The bytes from begin to end, fewer where the source ends. Of a file they are copied to the buffer, and a
  /// '<' and zero bytes, kGuard in all, follow them.
  std::string_view view(std::size_t begin, std::size_t end, std::string& buffer) const;

  static constexpr std::size_t kGuard = 16;

 private:
  std::string_view text_;
  const InputFile* file_ = nullptr;
  std::size_t size_;
};

/// A view of a source that moves along it.
class TextWindow {
 public:
  explicit TextWindow(const TextSource& source) : source_(source) { show(0, 1); }

  /// Makes the window cover `length` bytes from the offset on, as far as the source reaches. What was visible
  /// before may be gone.
  void show(std::size_t offset, std::size_t length);

  std::string_view text() const { return text_; }
  std::size_t begin() const { return begin_; }
  std::size_t end() const { return begin_ + text_.size(); }
  bool reaches_end() const { return short_ || end() >= source_.size(); }
  /// Visible bytes by their offsets in the source.
  std::string_view part(std::size_t begin, std::size_t end) const {
    return text_.substr(begin - begin_, end - begin);
  }
  const TextSource& source() const { return source_; }

 private:
  const TextSource& source_;
  std::string buffer_;
  std::string_view text_;
  std::size_t begin_ = 0;
  bool short_ = false;  // the file gave less than its size
};

/// Buffers for use in parallel; one that is given back is used again.
class BufferPool {
 public:
  std::string take();
  void give_back(std::string buffer);

 private:
  std::mutex mutex_;
  std::vector<std::string> free_;
};

}  // namespace meshcontour::detail

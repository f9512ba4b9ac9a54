#include "base/text_source.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace meshcontour::detail {
namespace {

constexpr std::size_t kWindow = std::size_t{256} << 10;

}  // namespace

std::string_view TextSource::view(std::size_t begin, std::size_t end, std::string& buffer) const {
  begin = std::min(begin, size_);
  const std::size_t wanted = std::clamp(end, begin, size_) - begin;
  if (file_ == nullptr) return text_.substr(begin, wanted);
  if (buffer.size() < wanted + kGuard) buffer.resize(wanted + kGuard);
  const std::size_t got = file_->read_at(buffer.data(), wanted, begin);
  std::memset(buffer.data() + got, 0, kGuard);
  buffer[got] = '<';
  return {buffer.data(), got};
}

void TextWindow::show(std::size_t offset, std::size_t length) {
  const bool inside = offset >= begin_ && offset <= end();
  if (inside && (offset + length <= end() || (reaches_end() && !text_.empty()))) return;
  const std::size_t size = std::max(length, kWindow);
  begin_ = std::min(offset, source_.size());
  text_ = source_.view(begin_, begin_ + size, buffer_);
  short_ = end() < std::min(begin_ + size, source_.size());
}

std::string BufferPool::take() {
  const std::lock_guard lock(mutex_);
  if (free_.empty()) return {};
  std::string buffer = std::move(free_.back());
  free_.pop_back();
  return buffer;
}

void BufferPool::give_back(std::string buffer) {
  const std::lock_guard lock(mutex_);
  free_.push_back(std::move(buffer));
}

}  // namespace meshcontour::detail

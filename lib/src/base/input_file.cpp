#include "base/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/openat2.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <system_error>

#include "meshcontour/error.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::size_t kHeadSize = 4096;
constexpr std::size_t kReadSize = std::size_t{4} << 20;
constexpr std::size_t kPage = 4096;

std::string reason(int error) {
  return std::generic_category().message(error);
}

[[noreturn]] void fail(ErrorCode code, const std::string& what, const std::string& name) {
  throw Error(code, what, Spot{name, 0, 0, ""});
}

// A pipe under one of these names was made for us; any other FIFO may never be written to.
bool names_open_descriptor(const std::string& name) {
  return name == "/dev/stdin" || name.starts_with("/dev/fd/") || name.starts_with("/proc/self/fd/");
}

int open_retrying(const char* name, int flags) {
  int fd = -1;
  do {
    fd = ::open(name, flags);
  } while (fd < 0 && errno == EINTR);
  return fd;
}

FileDescriptor open_named(const std::string& name) {
  const int fd = open_retrying(name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (fd < 0) fail(ErrorCode::NoInput, "cannot be opened: " + reason(errno), name);
  return FileDescriptor(fd);
}

std::string_view kind_refused(mode_t mode, bool pipes_allowed) {
  if (S_ISREG(mode)) return {};
  if (S_ISDIR(mode)) return "is a folder, not a file";
  if (S_ISFIFO(mode)) return pipes_allowed ? std::string_view() : "is a named pipe (FIFO), not a file";
  if (S_ISSOCK(mode)) return pipes_allowed ? std::string_view() : "is a socket, not a file";
  return "is a device, not a file";
}

bool starts_with_scheme(std::string_view name) {
  const std::size_t colon = name.find(':');
  if (colon == std::string_view::npos || colon == 0) return false;
  return std::ranges::all_of(name.substr(0, colon), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '+' ||
           c == '-' || c == '.';
  });
}

std::string_view reference_refused(std::string_view name) {
  if (name.empty()) return "the name is empty";
  const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (std::ranges::any_of(name, control)) return "the name holds a control character";
  if (name.find('\\') != std::string_view::npos) return "the name holds a backslash";
  if (name.front() == '/') return "the name is absolute";
  if (starts_with_scheme(name)) return "the name is a URL or has a drive letter";
  while (true) {
    const std::size_t slash = name.find('/');
    const std::string_view part = name.substr(0, slash);
    if (part.empty() || part == "." || part == "..") return "the name leaves or repeats its folder";
    if (slash == std::string_view::npos) return {};
    name.remove_prefix(slash + 1);
  }
}

// The kernel resolves the name and refuses whatever leaves the folder. Where it cannot (before Linux 5.6, or
// under a strict sandbox), only plain names that are no links are opened.
int open_beneath(int folder, const std::string& name) {
  open_how how{};
  how.flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  long fd = -1;
  do {
    fd = ::syscall(SYS_openat2, folder, name.c_str(), &how, sizeof how);
  } while (fd < 0 && (errno == EINTR || errno == EAGAIN));
  if (fd >= 0 || (errno != ENOSYS && errno != EPERM)) return static_cast<int>(fd);
  if (name.find('/') != std::string::npos) return -1;
  return ::openat(folder, name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY | O_NOFOLLOW);
}

std::size_t rounded_up(std::size_t size, std::size_t unit) {
  return (size + unit - 1) / unit * unit;
}

}  // namespace

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

FileDescriptor::~FileDescriptor() {
  if (fd_ >= 0) ::close(fd_);
}

FileBytes::FileBytes(FileBytes&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      capacity_(std::exchange(other.capacity_, 0)) {}

FileBytes& FileBytes::operator=(FileBytes&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  std::swap(capacity_, other.capacity_);
  return *this;
}

FileBytes::~FileBytes() {
  if (data_ != nullptr) ::munmap(data_, capacity_);
}

void FileBytes::grow(std::size_t capacity) {
  capacity = rounded_up(std::max<std::size_t>(capacity, 1), kPage);
  if (capacity <= capacity_) return;
  void* data = data_ == nullptr ? ::mmap(nullptr, capacity, PROT_READ | PROT_WRITE,
                                         MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0)
                                : ::mremap(data_, capacity_, capacity, MREMAP_MAYMOVE);
  if (data == MAP_FAILED) {
    throw Error(ErrorCode::OutOfMemory, fmt::format("{} bytes of input do not fit in memory", capacity));
  }
  data_ = static_cast<char*>(data);
  capacity_ = capacity;
}

InputFile::InputFile(const std::filesystem::path& file)
    : InputFile(open_named(file.string()), file.string(), names_open_descriptor(file.string())) {}

InputFile::InputFile(FileDescriptor fd, std::string name, bool descriptor)
    : fd_(std::move(fd)), name_(std::move(name)), descriptor_(descriptor) {
  struct stat status {};
  if (::fstat(fd_.get(), &status) != 0) fail(ErrorCode::NoInput, "cannot be opened: " + reason(errno), name_);
  if (const auto refused = kind_refused(status.st_mode, descriptor); !refused.empty()) {
    fail(ErrorCode::NoInput, std::string(refused), name_);
  }
  // A pipe's own reads may wait: whoever fills it is at work.
  if (!S_ISREG(status.st_mode)) ::fcntl(fd_.get(), F_SETFL, ::fcntl(fd_.get(), F_GETFL) & ~O_NONBLOCK);
  identity_ = {status.st_dev, status.st_ino};
  if (S_ISREG(status.st_mode)) {
    size_ = static_cast<std::size_t>(status.st_size);
    sparse_ = static_cast<std::size_t>(status.st_blocks) * 512 < size_;
  }
  head_.resize(kHeadSize);
  head_.resize(read_at(head_.data(), head_.size(), 0));
}

std::size_t InputFile::read_at(char* to, std::size_t size, std::size_t offset) const {
  std::size_t filled = 0;
  while (filled < size) {
    const std::size_t got = read_some(to + filled, size - filled, offset + filled);
    if (got == 0) break;
    filled += got;
  }
  return filled;
}

// Regular files are read by position; from a pipe the next bytes come, whatever the position.
std::size_t InputFile::read_some(char* to, std::size_t size, std::size_t offset) const {
  while (true) {
    const ssize_t got =
        size_ > 0 ? ::pread(fd_.get(), to, size, static_cast<off_t>(offset)) : ::read(fd_.get(), to, size);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) fail(ErrorCode::InputOutput, "cannot be read: " + reason(errno), name_);
  }
}

// Start and end of the data at or after the offset; size_ when only holes follow.
std::size_t InputFile::next_data(std::size_t offset, std::size_t& end) const {
  end = size_;
  if (!sparse_) return offset;
  const off_t data = ::lseek(fd_.get(), static_cast<off_t>(offset), SEEK_DATA);
  if (data < 0) return errno == ENXIO ? size_ : offset;
  const off_t hole = ::lseek(fd_.get(), data, SEEK_HOLE);
  if (hole > data) end = std::min(size_, static_cast<std::size_t>(hole));
  return static_cast<std::size_t>(data);
}

void InputFile::read_regular(FileBytes& bytes) const {
  bytes.grow(size_);
  std::size_t offset = 0;
  while (offset < size_) {
    std::size_t end = size_;
    offset = next_data(offset, end);
    while (offset < end) {
      const std::size_t got = read_some(bytes.data_ + offset, std::min(end - offset, kReadSize), offset);
      if (got == 0) {  // cut meanwhile
        bytes.size_ = offset;
        return;
      }
      offset += got;
    }
  }
  bytes.size_ = size_;
}

void InputFile::read_stream(FileBytes& bytes) const {
  bytes.grow(kReadSize);
  std::ranges::copy(head_, bytes.data_);
  bytes.size_ = head_.size();
  while (true) {
    if (bytes.size_ == bytes.capacity_) bytes.grow(bytes.capacity_ * 2);
    const std::size_t room = std::min(bytes.capacity_ - bytes.size_, kReadSize);
    const std::size_t got = read_some(bytes.data_ + bytes.size_, room, bytes.size_);
    if (got == 0) return;
    bytes.size_ += got;
  }
}

FileBytes InputFile::read() {
  FileBytes bytes;
  if (size_ > 0) {
    read_regular(bytes);
  } else {
    read_stream(bytes);
  }
  return bytes;
}

InputFolder::InputFolder(const std::filesystem::path& folder) : path_(folder) {
  const std::string name = folder.empty() ? "." : folder.string();
  const int fd = open_retrying(name.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) fail(ErrorCode::NoInput, "cannot be opened: " + reason(errno), name);
  fd_ = FileDescriptor(fd);
}

std::optional<InputFile> InputFolder::open(std::string_view name) const {
  const std::string shown = printable(name, 80);
  if (const auto refused = reference_refused(name); !refused.empty()) {
    fail(ErrorCode::BadData, fmt::format("reference '{}' refused: {}", shown, refused), path_.string());
  }
  const int fd = open_beneath(fd_.get(), std::string(name));
  if (fd >= 0) return InputFile(FileDescriptor(fd), (path_ / name).string(), false);
  if (errno == ENOENT) return std::nullopt;
  if (errno == EXDEV) {
    fail(ErrorCode::BadData, fmt::format("reference '{}' refused: it leads out of the folder", shown),
         path_.string());
  }
  fail(ErrorCode::NoInput, fmt::format("reference '{}' cannot be opened: {}", shown, reason(errno)),
       path_.string());
}

}  // namespace meshcontour::detail

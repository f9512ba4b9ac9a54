#include "base/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <system_error>
#include <utility>

namespace meshcontour {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBufferSize = std::size_t{1} << 18;
constexpr int kMostLinks = 40;  // as the kernel follows

// The descriptor that a name like "-" or /dev/fd/3 stands for. Opening such a name again would start at the
// beginning of the file behind it, or replace that file.
std::optional<int> named_descriptor(const std::string& path) {
  if (path == "-" || path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view prefix : {"/dev/fd/", "/proc/self/fd/"}) {
    int number = -1;
    const char* end = path.data() + path.size();
    if (path.starts_with(prefix) && std::from_chars(path.data() + prefix.size(), end, number).ptr == end)
      return number;
  }
  return std::nullopt;
}

// Follows symbolic links at the end of the path, to names that need not exist.
fs::path follow_links(fs::path path) {
  std::error_code error;
  for (int count = 0; count < kMostLinks; ++count) {
    if (!fs::is_symlink(fs::symlink_status(path, error))) return path;
    path = path.parent_path() / fs::read_symlink(path, error);
  }
  return path;
}

bool lacks_anonymous_files(int error) {
  return error == EOPNOTSUPP || error == EISDIR || error == EINVAL || error == ENOENT || error == ENOSYS;
}

}  // namespace

detail::Descriptor& detail::Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) close();
  number_ = std::exchange(other.number_, -1);
  return *this;
}

bool detail::Descriptor::close() noexcept {
  const int number = std::exchange(number_, -1);
  return number < 0 || ::close(number) == 0 || errno == EINTR;
}

OutputFile::OutputFile(const fs::path& target) : shown_(target.string()) {
  if (shown_ == "-") shown_ = "standard output";
  if (open_special(target)) return;
  open_folder(follow_links(target));
  create_temporary();
}

OutputFile::~OutputFile() = default;

void OutputFile::fail(ErrorCode code, const char* what, int error) const {
  throw Error(code, fmt::format("{}: {}", what, std::generic_category().message(error)),
              Spot{shown_, 0, 0, ""});
}

bool OutputFile::open_special(const fs::path& target) {
  struct stat status = {};
  if (const auto descriptor = named_descriptor(target.string())) {
    file_ = detail::Descriptor(fcntl(*descriptor, F_DUPFD_CLOEXEC, 3));
    const int access = file_.is_open() ? fcntl(file_.number(), F_GETFL) & O_ACCMODE : O_RDONLY;
    if (access == O_RDONLY) fail(ErrorCode::CannotCreate, "cannot write", file_.is_open() ? EBADF : errno);
  } else if (stat(target.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    if (S_ISDIR(status.st_mode)) fail(ErrorCode::CannotCreate, "cannot create", EISDIR);
    file_ = detail::Descriptor(open(target.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
    if (!file_.is_open()) fail(ErrorCode::CannotCreate, "cannot open", errno);
  }
  return file_.is_open();
}

void OutputFile::open_folder(const fs::path& target) {
  name_ = target.filename().string();
  if (name_.empty()) fail(ErrorCode::CannotCreate, "cannot create", target.empty() ? ENOENT : EISDIR);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const int flags = O_DIRECTORY | O_CLOEXEC;
  folder_ = detail::Descriptor(open(folder.c_str(), O_RDONLY | flags));
  if (!folder_.is_open() && errno == EACCES)
    folder_ = detail::Descriptor(open(folder.c_str(), O_PATH | flags));
  if (!folder_.is_open()) fail(ErrorCode::CannotCreate, "cannot open its folder", errno);
  if (fstat(folder_.number(), &folder_status_) != 0)
    fail(ErrorCode::CannotCreate, "cannot open its folder", errno);
  struct stat old = {};
  if (fstatat(folder_.number(), name_.c_str(), &old, 0) == 0) {
    old_ = old;
    if (faccessat(folder_.number(), name_.c_str(), W_OK, AT_EACCESS) != 0) {
      fail(ErrorCode::CannotCreate, "cannot replace", errno);
    }
  } else if (errno != ENOENT) {
    fail(ErrorCode::CannotCreate, "cannot create", errno);
  }
}

void OutputFile::create_temporary() {
  temporary_.emplace(folder_.number());
  constexpr mode_t mode = 0666;
  const int flags = O_WRONLY | O_CLOEXEC;
  file_ = detail::Descriptor(openat(folder_.number(), ".", O_TMPFILE | flags, mode));
  anonymous_ = file_.is_open() && access(fmt::format("/proc/self/fd/{}", file_.number()).c_str(), F_OK) == 0;
  if (!anonymous_) {
    if (!file_.is_open() && !lacks_anonymous_files(errno))
      fail(ErrorCode::CannotCreate, "cannot create", errno);
    file_ = detail::Descriptor(
        openat(folder_.number(), temporary_->name(), O_CREAT | O_EXCL | O_NOFOLLOW | flags, mode));
    if (!file_.is_open()) fail(ErrorCode::CannotCreate, "cannot create", errno);
    temporary_->created();
  }
  if (!old_) return;
  // Only root may give a file away; for others the new file is their own.
  [[maybe_unused]] const int ignored = fchown(file_.number(), old_->st_uid, old_->st_gid);
  if (fchmod(file_.number(), old_->st_mode & 07777) != 0)
    fail(ErrorCode::CannotCreate, "cannot set permissions", errno);
}

void OutputFile::write(std::string_view bytes) {
  if (buffer_.size() + bytes.size() > kBufferSize) flush();
  if (bytes.size() > kBufferSize) {
    write_all(bytes);
  } else {
    buffer_.append(bytes);
  }
}

void OutputFile::flush() {
  write_all(buffer_);
  buffer_.clear();
}

void OutputFile::write_all(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file_.number(), bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) fail(ErrorCode::InputOutput, "cannot write", errno);
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void OutputFile::finish() {
  flush();
  if (in_place()) {
    if (!file_.close()) fail(ErrorCode::InputOutput, "cannot write", errno);
  } else if (fsync(file_.number()) != 0) {
    fail(ErrorCode::InputOutput, "cannot write", errno);
  }
}

void OutputFile::name_temporary() {
  if (in_place() || !anonymous_) return;
  const std::string source = fmt::format("/proc/self/fd/{}", file_.number());
  if (linkat(AT_FDCWD, source.c_str(), folder_.number(), temporary_->name(), AT_SYMLINK_FOLLOW) != 0) {
    fail(ErrorCode::InputOutput, "cannot create", errno);
  }
  temporary_->created();
}

void OutputFile::place(bool restorable) {
  if (in_place()) return;
  const int folder = folder_.number();
  const char* from = temporary_->name();
  exchanged_ = restorable && old_ && renameat2(folder, from, folder, name_.c_str(), RENAME_EXCHANGE) == 0;
  if (!exchanged_ && renameat(folder, from, folder, name_.c_str()) != 0) {
    fail(ErrorCode::InputOutput, "cannot replace", errno);
  }
  placed_ = true;
}

void OutputFile::restore() noexcept {
  if (!placed_) return;
  const int folder = folder_.number();
  if (exchanged_) {
    renameat2(folder, temporary_->name(), folder, name_.c_str(), RENAME_EXCHANGE);
  } else if (!old_) {
    renameat(folder, name_.c_str(), folder, temporary_->name());
  }
}

void OutputFile::settle() {
  if (in_place()) return;
  temporary_.reset();
  // Some file systems cannot sync a folder, and a folder that may not be read cannot be either.
  if (fsync(folder_.number()) != 0 && errno == EIO)
    fail(ErrorCode::InputOutput, "cannot sync its folder", errno);
  if (!file_.close()) fail(ErrorCode::InputOutput, "cannot write", errno);
}

bool OutputFile::same_target(const OutputFile& other) const {
  return !in_place() && !other.in_place() && folder_status_.st_dev == other.folder_status_.st_dev &&
         folder_status_.st_ino == other.folder_status_.st_ino && name_ == other.name_;
}

}  // namespace meshcontour

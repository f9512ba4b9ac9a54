#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace meshcontour::detail {

/// An open file of the operating system, closed with its owner.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int fd) : fd_(fd) {}
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;
  ~FileDescriptor();

  int get() const { return fd_; }

 private:
  int fd_ = -1;
};

/// The content of a file, copied to memory once. A file that is cut or rewritten while it is read gives other
/// bytes, never a signal, as a mapped file would.
class FileBytes {
 public:
  FileBytes() = default;
  FileBytes(FileBytes&& other) noexcept;
  FileBytes& operator=(FileBytes&& other) noexcept;
  ~FileBytes();

  std::string_view view() const { return {data_, size_}; }

 private:
  friend class InputFile;
  void grow(std::size_t capacity);

  char* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

/// A file opened for reading. Only its first bytes are read before read() is called, so that a file of the
/// wrong kind costs nothing, whatever its size.
class InputFile {
 public:
  /// Opens a file that the user named: a regular file, or a pipe named /dev/stdin, /dev/fd/N or
  /// /proc/self/fd/N. Never waits for a named FIFO.
  ///
  /// @throws Error  NoInput if it cannot be opened or is a folder, a named FIFO, a socket or a device.
  explicit InputFile(const std::filesystem::path& file);

  /// As the user or the referring file wrote it, for messages.
  const std::string& name() const { return name_; }

  /// The first bytes, at most 4096; empty for an empty file.
  std::string_view head() const { return head_; }

  /// True for a name like /dev/stdin, whose folder says nothing about the file.
  bool is_descriptor() const { return descriptor_; }

  /// Bytes that the file system promises; 0 for a pipe.
  std::size_t size() const { return size_; }

  /// The whole content. Call it once. Holes of a sparse file take no memory.
  ///
  /// @throws Error  InputOutput if reading fails, OutOfMemory if the file does not fit.
  FileBytes read();

  /// Copies the bytes at an offset of a regular file; as many as there are. May be called from several
  /// threads.
  ///
  /// @throws Error  InputOutput if reading fails.
  std::size_t read_at(char* to, std::size_t size, std::size_t offset) const;

  /// Device and inode: equal for two names of one file.
  std::pair<dev_t, ino_t> identity() const { return identity_; }

 private:
  friend class InputFolder;
  InputFile(FileDescriptor fd, std::string name, bool descriptor);
  std::size_t read_some(char* to, std::size_t size, std::size_t offset) const;
  std::size_t next_data(std::size_t offset, std::size_t& end) const;
  void read_regular(FileBytes& bytes) const;
  void read_stream(FileBytes& bytes) const;

  FileDescriptor fd_;
  std::string name_;
  std::string head_;
  std::pair<dev_t, ino_t> identity_{};
  std::size_t size_ = 0;  // as the file system says; 0 for pipes
  bool sparse_ = false;
  bool descriptor_ = false;
};

/// A folder from which files may be opened that another file names, and nothing outside it.
class InputFolder {
 public:
  /// @throws Error  NoInput if the folder cannot be opened.
  explicit InputFolder(const std::filesystem::path& folder);

  /// Opens a regular file beneath the folder. Links are followed only as long as they stay beneath it.
  ///
  /// @param name    relative, with '/' between parts.
  /// @return        nothing if there is no such file.
  /// @throws Error  BadData, before anything is opened, if the name is empty, absolute, a URL, or holds '..',
  /// '.', a
  ///                backslash or a control character; NoInput if it cannot be opened or is not a regular
  ///                file.
  std::optional<InputFile> open(std::string_view name) const;

 private:
  FileDescriptor fd_;
  std::filesystem::path path_;
};

}  // namespace meshcontour::detail

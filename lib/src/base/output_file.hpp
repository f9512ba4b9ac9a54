#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "base/temporaries.hpp"
#include "meshcontour/output.hpp"

namespace meshcontour {

namespace detail {

/// Owns a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor() { close(); }

  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }

  /// False, with errno set, if the system reports a late write error.
  bool close() noexcept;

 private:
  int number_;
};

}  // namespace detail

/// One output file: an anonymous file in the target's folder until it is complete (a named one where the file
/// system has no anonymous files), or a special file that is written in place. The steps of a commit are
/// apart, so that a set can do each for all its files before the next.
class OutputFile final : public Sink {
 public:
  /// @throws Error   CannotCreate.
  explicit OutputFile(const std::filesystem::path& target);
  ~OutputFile() override;

  void write(std::string_view bytes) override;

  /// Writes what is buffered and syncs it; closes a special file.
  void finish();
  /// Gives an anonymous file the name of its temporary.
  void name_temporary();
  /// Renames the temporary to the target.
  ///
  /// @param restorable  keep the old content under the temporary's name.
  void place(bool restorable);
  /// Undoes place().
  void restore() noexcept;
  /// Lets go of the old content and syncs the folder.
  void settle();

  bool in_place() const { return !folder_.is_open(); }
  /// Both would be renamed to the same name.
  bool same_target(const OutputFile& other) const;

 private:
  [[noreturn]] void fail(ErrorCode code, const char* what, int error) const;
  bool open_special(const std::filesystem::path& target);
  void open_folder(const std::filesystem::path& target);
  void create_temporary();
  void flush();
  void write_all(std::string_view bytes);

  std::string shown_;          // the target as the caller wrote it, for messages
  detail::Descriptor folder_;  // closed for files written in place
  struct stat folder_status_ = {};
  std::string name_;  // in the folder, symbolic links followed
  std::optional<struct stat> old_;
  detail::Descriptor file_;
  std::string buffer_;
  bool anonymous_ = false;
  bool placed_ = false;
  bool exchanged_ = false;                      // the temporary's name holds the old content
  std::optional<detail::Temporary> temporary_;  // after folder_: it goes first
};

}  // namespace meshcontour

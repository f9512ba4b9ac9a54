#pragma once

#include <cstdio>
#include <memory>
#include <set>
#include <string>

#include "file_job.hpp"

namespace meshcontour::app {

/// Remembers which inputs are done, so that a batch that was stopped goes on where it was.
///
/// A line is written for every input that succeeded: a hash of its path, size and time of change, of its
/// outputs, of all options that matter to them and of the program's version. A line that was cut off is no
/// line.
class Journal {
 public:
  /// @param path    empty: nothing is remembered.
  /// @throws Error  CannotCreate if it cannot be opened for appending.
  explicit Journal(const std::string& path, const CommandLine& line);

  /// Whether the job was done before, its input has not changed since and its outputs are there.
  bool holds(const FileJob& job) const;

  /// Adds a job that succeeded; on disk when this returns, as far as the process goes.
  void add(const FileJob& job);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::string key(const FileJob& job) const;

  std::string options_;
  std::set<std::string> done_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace meshcontour::app

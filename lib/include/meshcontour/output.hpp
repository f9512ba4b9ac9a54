#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "meshcontour/error.hpp"

namespace meshcontour {

/// Where the bytes of a writer go.
class Sink {
 public:
  Sink() = default;
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;
  virtual ~Sink() = default;

  /// Appends bytes.
  ///
  /// @throws Error   InputOutput if they cannot be written.
  virtual void write(std::string_view bytes) = 0;
};

/// A sink that keeps everything in memory.
class StringSink final : public Sink {
 public:
  void write(std::string_view bytes) override { text.append(bytes); }

  std::string text;
};

class OutputFile;

/// The output files of one job: all of them appear, whole and synced to disk, or none does.
///
/// Each file is written to a temporary in the folder of its target. commit() syncs all temporaries and only
/// then renames them; when a rename fails, the targets renamed before get their old content back. Until
/// commit() succeeds the old files stay as they were; without it the temporaries go away with the set.
/// Standard output ("-") and special files (/dev/full, /dev/stdout, /dev/fd/N, FIFOs, terminals) cannot be
/// renamed and are written in place.
class OutputSet {
 public:
  OutputSet();
  OutputSet(const OutputSet&) = delete;
  OutputSet& operator=(const OutputSet&) = delete;
  ~OutputSet();

  /// Creates the temporary of one output; call it for every output before any work is done.
  ///
  /// Symbolic links are followed; an existing file keeps its permissions.
  ///
  /// @param target  a path, or "-" for standard output.
  /// @return        valid until the set is destroyed.
  /// @throws Error  CannotCreate, with the system's reason, if the target is a folder or cannot be created or
  /// written;
  ///                Usage if the set holds the same target already.
  Sink& open(const std::filesystem::path& target);

  /// Makes all outputs appear. Nothing may be written afterwards.
  ///
  /// @throws Error   InputOutput if an output could not be written, synced or renamed; then none has changed.
  void commit();

 private:
  std::vector<std::unique_ptr<OutputFile>> files_;
};

/// Makes the process safe to end at any time; the program calls it once, before it starts a thread or opens a
/// file.
///
/// SIGINT, SIGTERM and SIGHUP remove the temporaries of all output sets and then end the process as without a
/// handler (signals that are ignored already stay ignored). SIGPIPE and SIGXFSZ are ignored, so that a closed
/// pipe and a file size limit become errors of the write. Standard descriptors that are closed are occupied,
/// so that no file of ours takes their place; using them still fails.
void prepare_process();

/// Removes the temporaries of all output sets of this process. Safe in a signal handler.
void remove_temporaries() noexcept;

}  // namespace meshcontour

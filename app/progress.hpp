#pragma once

#include <cstddef>
#include <string>

namespace meshcontour::app {

/// Tells on standard error how far a batch is: a bar on a terminal, otherwise a line at every tenth of 20 or
/// more inputs; nothing when quiet.
class Progress {
 public:
  Progress(std::size_t count, int verbosity);
  ~Progress() { clear(); }

  /// One more is done.
  void step(const std::string& name);
  /// Takes the bar away, so that something else can be printed.
  void clear();

 private:
  std::size_t count_, done_ = 0;
  bool shown_, terminal_, drawn_ = false;
};

}  // namespace meshcontour::app

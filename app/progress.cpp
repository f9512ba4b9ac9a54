#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "meshcontour/error.hpp"

namespace meshcontour::app {
namespace {

constexpr std::size_t kBarWidth = 30, kNameWidth = 32;
constexpr std::size_t kFewest = 20;  // fewer inputs get no lines of progress

}  // namespace

Progress::Progress(std::size_t count, int verbosity)
    : count_(count), shown_(verbosity >= 0 && count > 1), terminal_(isatty(STDERR_FILENO) == 1) {}

void Progress::step(const std::string& name) {
  ++done_;
  if (!shown_) return;
  if (terminal_) {
    const std::size_t filled = done_ * kBarWidth / count_;
    fmt::print(stderr, "\r\x1b[K[{:#<{}}{: <{}}] {}/{} {}", "", filled, "", kBarWidth - filled, done_, count_,
               printable(std::filesystem::path(name).filename().string(), kNameWidth));
    std::fflush(stderr);
    drawn_ = true;
  } else if (count_ >= kFewest && done_ * 10 / count_ != (done_ - 1) * 10 / count_ && done_ < count_) {
    fmt::print(stderr, "meshcontour: {} of {}\n", done_, count_);
  }
}

void Progress::clear() {
  if (drawn_) fmt::print(stderr, "\r\x1b[K");
  drawn_ = false;
}

}  // namespace meshcontour::app

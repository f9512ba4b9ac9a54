#include "journal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "meshcontour/version.hpp"

namespace meshcontour::app {
namespace {

namespace fs = std::filesystem;

// FNV-1a with 128 bits [Fowler, Noll & Vo], so that two jobs never share a key by accident.
std::string hash(const std::string& text) {
  __extension__ using Wide = unsigned __int128;
  constexpr Wide kPrime = (Wide{1} << 88) + 0x13b;
  Wide value = (Wide{0x6c62272e07bb0142} << 64) + 0x62b821756295c58d;
  for (const char c : text) value = (value ^ static_cast<unsigned char>(c)) * kPrime;
  return fmt::format("{:016x}{:016x}", static_cast<std::uint64_t>(value >> 64),
                     static_cast<std::uint64_t>(value));
}

}  // namespace

Journal::Journal(const std::string& path, const CommandLine& line) : options_(line.options_text) {
  if (path.empty()) return;
  std::ifstream in(path);
  for (std::string key; std::getline(in, key) && !in.eof();) done_.insert(key);
  in.close();
  file_.reset(std::fopen(path.c_str(), "ae"));
  if (!file_) {
    throw Error(ErrorCode::CannotCreate, fmt::format("cannot be opened: {}", std::strerror(errno)),
                {path, 0, 0, {}});
  }
  // Ends a line that was cut off, so that the next one stands alone.
  std::fputc('\n', file_.get());
}

std::string Journal::key(const FileJob& job) const {
  std::error_code unknown;
  const auto size = fs::file_size(job.input, unknown);
  const auto time = fs::last_write_time(job.input, unknown).time_since_epoch().count();
  std::string text = fmt::format("{}\n{}\n{}\n{}\n{}", version(), options_, job.input, size, time);
  for (const std::string& path : output_paths(job)) text += '\n' + path;
  return hash(text);
}

bool Journal::holds(const FileJob& job) const {
  const auto exists = [](const std::string& path) {
    std::error_code unknown;
    return fs::exists(path, unknown);
  };
  return file_ && done_.contains(key(job)) && std::ranges::all_of(output_paths(job), exists);
}

void Journal::add(const FileJob& job) {
  if (!file_) return;
  fmt::print(file_.get(), "{}\n", key(job));
  std::fflush(file_.get());
}

}  // namespace meshcontour::app

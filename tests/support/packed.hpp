#pragma once

// Files that may be packed with xz.

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

/// The bytes of a file, or of its packed form (FILE.xz, or FILE itself if it ends so); nothing if it is
/// absent or xz is.
inline std::optional<std::string> unpacked(const std::filesystem::path& file) {
  const bool packed = file.extension() == ".xz" || !std::filesystem::exists(file);
  if (!packed) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }
  const std::string name = file.extension() == ".xz" ? file.string() : file.string() + ".xz";
  if (!std::filesystem::exists(name)) return std::nullopt;
  std::FILE* pipe = ::popen(("xz -dc '" + name + "'").c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string bytes;
  char block[65536];
  while (const std::size_t got = std::fread(block, 1, sizeof block, pipe)) bytes.append(block, got);
  return ::pclose(pipe) == 0 ? std::optional(bytes) : std::nullopt;
}

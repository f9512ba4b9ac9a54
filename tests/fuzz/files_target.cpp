// A model and the files that it names, read from a folder. Behind a byte that chooses options come the files,
// each behind a line "@NAME"; the first is the one that is read.

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "fuzz/outcome.hpp"
#include "fuzz/targets.hpp"
#include "meshcontour/read.hpp"
#include "support/temporary_folder.hpp"

namespace fuzz {
namespace {

using namespace meshcontour;

struct File {
  std::string name;
  std::string_view bytes;
};

bool is_name(std::string_view name) {
  constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyz0123456789_.";
  return !name.empty() && name.size() < 40 && name[0] != '.' && name.find_first_not_of(kAllowed) == name.npos;
}

std::vector<File> files_of(std::string_view text) {
  std::vector<File> files;
  while (text.starts_with('@')) {
    const std::size_t line = std::min(text.find('\n'), text.size());
    const std::string_view name = text.substr(1, line - 1);
    text.remove_prefix(std::min(line + 1, text.size()));
    const std::size_t next = text.find("\n@");
    const std::string_view bytes = text.substr(0, next);
    if (is_name(name)) files.push_back({std::string(name), bytes});
    text.remove_prefix(next == text.npos ? text.size() : next + 1);
  }
  return files;
}

ReadOptions options_of(std::uint8_t choice) {
  ReadOptions options;
  options.strict = (choice & 1) != 0;
  options.max_triangles = (choice & 2) != 0 ? 3 : 20'000;
  options.max_instances = (choice & 2) != 0 ? 3 : 1'000;
  options.sweep.max_frames = 1'000;
  if ((choice & 4) != 0) options.weld = 0.01;
  options.net.normalise = (choice & 8) != 0;
  options.net.strict = (choice & 16) != 0;
  options.net.mend = (choice & 32) != 0;
  return options;
}

}  // namespace

void read_files(Bytes input) {
  static const TemporaryFolder folder;
  Source source(input);
  ReadOptions options = options_of(source.byte());
  const std::vector<File> files = files_of(text_of(input.subspan(std::min<std::size_t>(1, input.size()))));
  if (files.empty()) return;
  for (const File& file : files) write_file(folder / file.name, std::string(file.bytes));

  const std::filesystem::path first = folder / files[0].name;
  options.threads = 1;
  const std::string alone = outcome([&] { return read_model(first, options); });
  options.threads = 3;
  require(outcome([&] { return read_model(first, options); }) == alone,
          "several threads read something else");
  // Without a folder every named file is missing.
  const bool names_files = files[0].bytes.find("href") != files[0].bytes.npos ||
                           files[0].bytes.find("mtllib") != files[0].bytes.npos;
  if (!names_files && files.size() == 1) {
    require(outcome([&] { return read_model(files[0].bytes, first.string(), options); }) == alone,
            "bytes in memory are read as something else than their file");
  }
  for (const File& file : files) std::filesystem::remove(folder / file.name);
}

}  // namespace fuzz

#include "inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "meshcontour/error.hpp"
#include "meshcontour/read.hpp"

namespace meshcontour::app {
namespace {

namespace fs = std::filesystem;

std::string lower_case_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension.empty() ? extension : extension.substr(1);
}

std::vector<std::string> models_below(const fs::path& folder) {
  const std::vector<std::string> known = readable_extensions();
  std::vector<std::string> files;
  try {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
      const bool model = std::ranges::find(known, lower_case_extension(entry.path())) != known.end();
      std::error_code unknown;  // a link to nowhere is a file that cannot be read, and is named as one
      if (model && !entry.is_directory(unknown)) files.push_back(entry.path().string());
    }
  } catch (const fs::filesystem_error& error) {
    throw Error(ErrorCode::NoInput, fmt::format("cannot list the folder: {}", error.code().message()),
                {folder.string(), 0, 0, {}});
  }
  if (files.empty()) {
    throw Error(ErrorCode::NoInput, fmt::format("the folder holds no model ({})", fmt::join(known, ", ")),
                {folder.string(), 0, 0, {}});
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace

std::vector<std::string> expand_inputs(const std::vector<std::string>& inputs) {
  std::vector<std::string> files;
  for (const std::string& input : inputs) {
    std::error_code unknown;
    if (input != "-" && fs::is_directory(input, unknown)) {
      std::ranges::move(models_below(input), std::back_inserter(files));
    } else {
      files.push_back(input);
    }
  }
  return files;
}

std::vector<std::string> take_shard(const std::vector<std::string>& inputs,
                                    std::pair<std::size_t, std::size_t> shard) {
  std::vector<std::string> part;
  for (std::size_t i = shard.first - 1; i < inputs.size(); i += shard.second) part.push_back(inputs[i]);
  return part;
}

}  // namespace meshcontour::app

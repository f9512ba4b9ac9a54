#include <algorithm>

#include "base/output_file.hpp"
#include "meshcontour/output.hpp"

namespace meshcontour {

OutputSet::OutputSet() = default;
OutputSet::~OutputSet() = default;

Sink& OutputSet::open(const std::filesystem::path& target) {
  auto file = std::make_unique<OutputFile>(target);
  if (std::ranges::any_of(files_, [&](const auto& other) { return file->same_target(*other); })) {
    throw Error(ErrorCode::Usage, "named twice as an output", Spot{target.string(), 0, 0, ""});
  }
  files_.push_back(std::move(file));
  return *files_.back();
}

void OutputSet::commit() {
  // What is written in place cannot be taken back, so it must not be the reason for a renamed file to be
  // lost.
  for (const auto& file : files_) {
    if (file->in_place()) file->finish();
  }
  for (const auto& file : files_) {
    if (!file->in_place()) file->finish();
  }
  const detail::SignalsHeld held;
  for (const auto& file : files_) file->name_temporary();
  try {
    for (const auto& file : files_) file->place(files_.size() > 1);
  } catch (...) {
    for (const auto& file : files_) file->restore();
    throw;
  }
  for (const auto& file : files_) file->settle();
}

}  // namespace meshcontour

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_file.hpp"
#include "meshcontour/read.hpp"

namespace meshcontour::detail {

/// What a reader knows besides the bytes.
struct ReadContext {
  std::string name;  ///< of the input, for messages
  const ReadOptions& options;
  const InputFolder* folder = nullptr;  ///< where files that it names may be read; null: nowhere
};

/// How surely the first bytes are of a format.
enum class Match {
  No,
  IfNamed,   ///< taken only if the extension agrees
  Possible,  ///< nothing speaks against it; taken when the extension agrees, or nothing else is possible
  Sure,      ///< a signature, taken whatever the extension
};

/// One row of the table of input formats.
struct Format {
  std::string_view name;                     ///< for messages, e.g. "STL"
  std::vector<std::string_view> extensions;  ///< lower case, without the dot
  /// @param head  the first bytes, at most 4096.
  /// @param size  of the whole input in bytes; 0 when it is not known (a pipe).
  Match (*sniff)(std::string_view head, std::uint64_t size);
  /// Gives a model that passes validate(); what it mended is in Model::diagnostics.
  Model (*read)(std::string_view bytes, const ReadContext& context);
  /// The same for regular files, without reading them as a whole; null: there is no such way.
  Model (*read_file)(InputFile& file, const ReadContext& context) = nullptr;
};

/// Every format that can be read; earlier rows win where two match equally well. A new format is one row here
/// and one source file.
std::span<const Format> formats();

/// The format of an input: by content, with the extension as a hint.
///
/// @throws Error  BadData if no format fits, naming those that are known.
const Format& detect_format(std::string_view head, std::uint64_t size, std::string_view name,
                            std::span<const Format> table);

}  // namespace meshcontour::detail

#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace meshcontour {

/// Why a call failed. The values are the process exit codes of the command-line tool (sysexits.h where it has
/// one).
enum class ErrorCode {
  Usage = 64,         ///< an option or argument is out of range or contradicts another
  BadData = 65,       ///< the input was read and is wrong
  NoInput = 66,       ///< the input does not exist or cannot be opened
  NoRenderer = 69,    ///< no OpenGL context could be made, or it draws nothing
  Internal = 70,      ///< a fault of ours
  OutOfMemory = 71,   ///< memory ran out, or the input asks for more than the limit
  CannotCreate = 73,  ///< an output cannot be created
  InputOutput = 74,   ///< reading or writing failed half way
  TimeLimit = 75,     ///< the time limit was reached
};

/// A place in an input. Empty or zero members are unknown.
struct Spot {
  std::string file;
  std::size_t line = 0;    ///< from 1
  std::size_t column = 0;  ///< from 1, in bytes
  std::string element;     ///< what was being read, e.g. "shell id34808"

  /// "file:line:column: element", without the unknown parts.
  std::string text() const;
};

/// The one exception of the library. what() is a whole line for the person who ran the command.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message, Spot spot = {});

  ErrorCode code() const { return code_; }
  const Spot& spot() const { return spot_; }

 private:
  ErrorCode code_;
  Spot spot_;
};

/// Something that was mended, skipped or is worth knowing, returned beside a result.
struct Diagnostic {
  enum class Severity { Note, Warning };

  Severity severity = Severity::Warning;
  std::string message;
  Spot spot;              ///< of the first occurrence
  std::size_t count = 1;  ///< occurrences that this line stands for

  /// "file:line: warning: message (3 times)", with control bytes escaped.
  std::string text() const;
};

/// The text with control bytes and invalid UTF-8 made visible (\x1b, U+FFFD), cut to at most `limit` bytes.
/// For every name or text of a file that goes into a message.
std::string printable(std::string_view text, std::size_t limit = 200);

}  // namespace meshcontour

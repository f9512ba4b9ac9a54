#pragma once

#include <string>
#include <string_view>

#include "meshcontour/error.hpp"

namespace meshcontour::app {

/// How messages are written to standard error.
enum class MessageStyle {
  Text,    ///< "meshcontour: file:line: warning: ..."
  GitHub,  ///< commands to GitHub Actions, which shows them beside the file: "::warning
           ///< file=...,line=...::..."
};

enum class MessageKind { Error, Warning, Notice };

/// A message as a line, with its end.
///
/// @param text  whole, with its place; escaped where it comes from a file.
/// @param spot  its place again.
std::string message_line(MessageKind kind, std::string_view text, const Spot& spot, MessageStyle style);

}  // namespace meshcontour::app

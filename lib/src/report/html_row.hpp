#pragma once

#include "base/text_writer.hpp"
#include "report/report_data.hpp"

namespace meshcontour::detail {

/// A text of a file for HTML content and for attributes in quotes; control characters are made visible.
std::string html_text(std::string_view text);

/// "12.3 ms", "4.56 s"
std::string duration(double milliseconds);

/// "812 bytes", "1.4 MB"
std::string byte_size(std::uint64_t bytes);

/// A stage's colour as a class of page.css; empty if it has none.
std::string_view stage_class(std::string_view stage);

/// The column heads of the table of files, and the row of one.
///
/// @param number   of the file, from 1: its model is in the element `model-N`.
/// @param slowest  milliseconds that a bar of full width stands for, above 0.
/// @param open     details are shown at once.
void write_heads(TextWriter& out);
void write_row(const FileReport& report, std::size_t number, double slowest, bool open, TextWriter& out);

}  // namespace meshcontour::detail

#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "choices.hpp"
#include "meshcontour/error.hpp"
#include "meshcontour/report.hpp"
#include "meshcontour/simplification.hpp"
#include "meshcontour/units.hpp"

namespace meshcontour::app {

// Values of options as the user types them. All throw Error{Usage} with a message that names the option, the
// text and what would be right.

/// Any other fault of the command line.
[[noreturn]] void usage(const std::string& message);

[[noreturn]] void refuse(std::string_view option, std::string_view text, std::string_view expected);

/// A whole number from 0 to `largest`.
std::uint64_t parse_count(std::string_view text, std::string_view option, std::uint64_t largest = UINT64_MAX);

/// A finite number above zero.
double parse_positive(std::string_view text, std::string_view option);

/// A finite number, zero or above.
double parse_length(std::string_view text, std::string_view option);

/// "500MB", "2GB", "1.5GiB", "4096"; in bytes, at least 1.
std::uint64_t parse_bytes(std::string_view text, std::string_view option);

/// "3/8": number from 1 and count.
std::pair<std::size_t, std::size_t> parse_shard(std::string_view text);

/// "FILE" or "FORMAT:FILE"; what stands before a colon and is no format is part of the file's name.
std::pair<ReportFormat, std::string> parse_report_target(std::string_view text);

/// "error:0.1", "ratio:0.25" or "triangles:5000" as goal and value.
void parse_simplification(std::string_view text, SimplifyOptions& options);

/// "1280x960"
std::pair<int, int> parse_size(std::string_view text);

/// "edges=ff0000": a layer and its colour; "edges=2.5": a layer and the width of its lines in pixels, up
/// to 64.
LayerStyle parse_layer_color(std::string_view text);
LayerStyle parse_layer_width(std::string_view text);

/// The symbols of all units, with commas.
std::string unit_symbols();

/// The metres of a unit's symbol.
double parse_unit(std::string_view text, std::string_view option);

/// "none", "rrggbb" or "rrggbbaa", with or without '#'.
std::optional<Rgba> parse_background(std::string_view text);

/// "4,7-9" as first and last of each range, numbers from 1.
std::vector<std::pair<std::size_t, std::size_t>> parse_ranges(std::string_view text, std::string_view option);

/// The parts between commas; an empty text has none.
std::vector<std::string_view> split_commas(std::string_view text);

template <class T, std::size_t N>
T parse_choice(std::string_view text, const Choices<T, N>& choices, std::string_view option) {
  for (const auto& [word, value] : choices) {
    if (word == text) return value;
  }
  refuse(option, text, "one of " + words(choices));
}

/// Words between commas, each at most once, at least one.
template <class T, std::size_t N>
std::vector<T> parse_choices(std::string_view text, const Choices<T, N>& choices, std::string_view option) {
  std::vector<T> out;
  for (const std::string_view part : split_commas(text)) {
    const T value = parse_choice(part, choices, option);
    if (std::ranges::find(out, value) != out.end()) refuse(option, text, "each word once");
    out.push_back(value);
  }
  if (out.empty()) refuse(option, text, "some of " + words(choices));
  return out;
}

template <class T, std::size_t N>
std::string join_words(const std::vector<T>& values, const Choices<T, N>& choices) {
  std::string out;
  for (const T value : values) {
    if (!out.empty()) out += ',';
    out += word_of(choices, value);
  }
  return out;
}

/// With its dot; empty where there is none.
std::string extension(const std::string& path);

/// The output's name with {stem}, {dir}, {n} and {view} filled in: the input's name without folder and
/// extension, its folder, its number, the picture's view.
std::string fill_template(std::string_view name, const std::string& input, std::size_t number,
                          std::string_view view);

}  // namespace meshcontour::app

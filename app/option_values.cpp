#include "option_values.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>

namespace meshcontour::app {
namespace {

// The whole text as a number, nothing where it is not one.
template <class T>
std::optional<T> whole_number(std::string_view text) {
  T value{};
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<std::uint8_t> hexadecimal_byte(std::string_view text) {
  std::uint8_t value{};
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<Rgba> hexadecimal_color(std::string_view text) {
  const std::string_view digits = text.starts_with('#') ? text.substr(1) : text;
  if (digits.size() != 6 && digits.size() != 8) return std::nullopt;
  const auto channel = [&](std::size_t at) { return hexadecimal_byte(digits.substr(at, 2)); };
  const auto red = channel(0), green = channel(2), blue = channel(4),
             alpha = digits.size() == 8 ? channel(6) : std::optional<std::uint8_t>(255);
  if (!red || !green || !blue || !alpha) return std::nullopt;
  return Rgba{*red, *green, *blue, *alpha};
}

// Both sides of an equals sign.
std::pair<Layer, std::string_view> layer_and_value(std::string_view text, std::string_view option,
                                                   std::string_view expected) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos) refuse(option, text, expected);
  return {parse_choice(text.substr(0, equals), kLayers, option), text.substr(equals + 1)};
}

}  // namespace

std::string unit_symbols() {
  std::string out;
  for (const LengthUnit& unit : kLengthUnits) out += (out.empty() ? "" : ", ") + std::string(unit.symbol);
  return out;
}

void usage(const std::string& message) {
  throw Error(ErrorCode::Usage, message + "\nTry 'meshcontour --help'.");
}

void refuse(std::string_view option, std::string_view text, std::string_view expected) {
  throw Error(ErrorCode::Usage,
              fmt::format("{}: expected {}, found '{}'", option, expected, printable(text)));
}

std::uint64_t parse_count(std::string_view text, std::string_view option, std::uint64_t largest) {
  const auto value = whole_number<std::uint64_t>(text);
  if (!value) refuse(option, text, "a whole number");
  if (*value > largest) refuse(option, text, fmt::format("at most {}", largest));
  return *value;
}

double parse_positive(std::string_view text, std::string_view option) {
  const auto value = whole_number<double>(text);
  if (!value || !std::isfinite(*value) || *value <= 0) refuse(option, text, "a number above zero");
  return *value;
}

double parse_length(std::string_view text, std::string_view option) {
  const auto value = whole_number<double>(text);
  if (!value || !std::isfinite(*value) || *value < 0) refuse(option, text, "a number, zero or above");
  return *value;
}

std::uint64_t parse_bytes(std::string_view text, std::string_view option) {
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"KB", 1e3}, {"MB", 1e6}, {"GB", 1e9}, {"KiB", 1 << 10}, {"MiB", 1 << 20}, {"GiB", 1 << 30}, {"B", 1}};
  double scale = 1;
  std::string_view digits = text;
  for (const auto& [unit, bytes] : kUnits) {
    if (!digits.ends_with(unit)) continue;
    digits.remove_suffix(unit.size());
    scale = bytes;
    break;
  }
  const auto value = whole_number<double>(digits);
  if (!value || !(*value * scale >= 1) || *value * scale > 1e18)
    refuse(option, text, "a size as in 500MB or 2GB");
  return static_cast<std::uint64_t>(*value * scale);
}

std::pair<std::size_t, std::size_t> parse_shard(std::string_view text) {
  const std::size_t slash = text.find('/');
  const auto number = whole_number<std::size_t>(text.substr(0, slash));
  const auto count = whole_number<std::size_t>(slash == text.npos ? "" : text.substr(slash + 1));
  if (!number || !count || *number < 1 || *number > *count) refuse("--shard", text, "I/N with I from 1 to N");
  return {*number, *count};
}

std::pair<ReportFormat, std::string> parse_report_target(std::string_view text) {
  const std::size_t colon = text.find(':');
  const auto format = colon == text.npos ? std::nullopt : report_format(text.substr(0, colon));
  const std::string_view file = format ? text.substr(colon + 1) : text;
  if (file.empty()) refuse("--report", text, "a file, or FORMAT:FILE");
  return {format.value_or(ReportFormat::Json), std::string(file)};
}

void parse_simplification(std::string_view text, SimplifyOptions& options) {
  constexpr std::string_view kOption = "--simplify";
  const std::size_t colon = text.find(':');
  if (colon == text.npos) refuse(kOption, text, "error:LENGTH, ratio:SHARE or triangles:N");
  options.goal = parse_choice(text.substr(0, colon), kSimplifyGoals, kOption);
  const std::string_view value = text.substr(colon + 1);
  options.value = parse_positive(value, kOption);
  if (options.goal == SimplifyGoal::Ratio && options.value > 1) refuse(kOption, text, "a share of at most 1");
  if (options.goal == SimplifyGoal::Triangles) {
    options.value = static_cast<double>(parse_count(value, kOption, 1'000'000'000));
  }
}

std::pair<int, int> parse_size(std::string_view text) {
  const std::size_t cross = text.find('x');
  const auto width = whole_number<int>(text.substr(0, cross));
  const auto height = whole_number<int>(cross == text.npos ? "" : text.substr(cross + 1));
  const auto fits = [](const std::optional<int>& side) { return side && *side >= 1 && *side <= 16384; };
  if (!fits(width) || !fits(height)) refuse("--size", text, "WIDTHxHEIGHT with 1 to 16384 pixels a side");
  return {*width, *height};
}

std::optional<Rgba> parse_background(std::string_view text) {
  if (text == "none") return std::nullopt;
  const auto color = hexadecimal_color(text);
  if (!color) refuse("--background", text, "none, rrggbb or rrggbbaa");
  return color;
}

LayerStyle parse_layer_color(std::string_view text) {
  constexpr std::string_view kOption = "--color";
  const auto [layer, value] = layer_and_value(text, kOption, "LAYER=rrggbb");
  const auto color = hexadecimal_color(value);
  if (!color || color->alpha != 255) refuse(kOption, value, "rrggbb");
  return {layer, color, std::nullopt};
}

LayerStyle parse_layer_width(std::string_view text) {
  constexpr std::string_view kOption = "--line-width";
  const auto [layer, value] = layer_and_value(text, kOption, "LAYER=PIXELS");
  const double width = parse_positive(value, kOption);
  if (width > kWidestLine) refuse(kOption, value, fmt::format("at most {} pixels", kWidestLine));
  return {layer, std::nullopt, width};
}

double parse_unit(std::string_view text, std::string_view option) {
  const auto metres = metres_of(text);
  if (!metres) refuse(option, text, "one of " + unit_symbols());
  return *metres;
}

std::vector<std::string_view> split_commas(std::string_view text) {
  std::vector<std::string_view> parts;
  if (text.empty()) return parts;
  for (;;) {
    const std::size_t comma = text.find(',');
    parts.push_back(text.substr(0, comma));
    if (comma == text.npos) return parts;
    text.remove_prefix(comma + 1);
  }
}

std::vector<std::pair<std::size_t, std::size_t>> parse_ranges(std::string_view text,
                                                              std::string_view option) {
  std::vector<std::pair<std::size_t, std::size_t>> ranges;
  for (const std::string_view part : split_commas(text)) {
    const std::size_t dash = part.find('-');
    const auto first = whole_number<std::size_t>(part.substr(0, dash));
    const auto last = dash == part.npos ? first : whole_number<std::size_t>(part.substr(dash + 1));
    if (!first || !last || *first < 1 || *last < *first) break;
    ranges.emplace_back(*first, *last);
  }
  if (ranges.empty() || ranges.size() != split_commas(text).size()) {
    refuse(option, text, "numbers from 1 and ranges, as in 4,7-9");
  }
  return ranges;
}

std::string extension(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

std::string fill_template(std::string_view name, const std::string& input, std::size_t number,
                          std::string_view view) {
  const std::filesystem::path path = input == "-" ? "stdin" : input;
  const std::pair<std::string_view, std::string> fields[] = {
      {"{stem}", path.stem().string()},
      {"{dir}", path.has_parent_path() ? path.parent_path().string() : "."},
      {"{n}", fmt::format("{}", number)},
      {"{view}", std::string(view)}};
  std::string out;
  while (!name.empty()) {
    bool replaced = false;
    for (const auto& [field, value] : fields) {
      if (!name.starts_with(field)) continue;
      out += value;
      name.remove_prefix(field.size());
      replaced = true;
      break;
    }
    if (replaced) continue;
    out += name.front();
    name.remove_prefix(1);
  }
  return out;
}

}  // namespace meshcontour::app

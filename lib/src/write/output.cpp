#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>

#include "write/writers.hpp"

namespace meshcontour {
namespace {

using Writer = void (*)(const Result&, const WriteOptions&, Sink&, std::vector<Diagnostic>&);

struct Row {
  std::string_view name;
  OutputFormat format;
  Writer writer;  // null: a picture
};

constexpr std::array<Row, 10> kFormats = {{{"png", OutputFormat::Png, nullptr},
                                           {"csv", OutputFormat::Csv, detail::write_csv},
                                           {"obj", OutputFormat::Obj, detail::write_obj},
                                           {"step", OutputFormat::Step, detail::write_step},
                                           {"dxf", OutputFormat::Dxf, detail::write_dxf},
                                           {"svg", OutputFormat::Svg, detail::write_svg},
                                           {"json", OutputFormat::Json, detail::write_json},
                                           {"glb", OutputFormat::Glb, detail::write_glb},
                                           {"wrl", OutputFormat::Wrl, detail::write_wrl},
                                           {"stp", OutputFormat::Step, detail::write_step}}};

constexpr auto kNames = [] {
  std::array<std::string_view, 9> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kFormats[i].name;
  return names;
}();

constexpr std::int64_t kLastSecond = 253'402'300'799;  // of the year 9999: ISO 8601 has four digits

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

std::optional<OutputFormat> output_format(std::string_view name) {
  if (name.starts_with('.')) name.remove_prefix(1);
  const auto is_named = [&](const Row& row) { return std::ranges::equal(row.name, name, {}, {}, lower); };
  const auto row = std::ranges::find_if(kFormats, is_named);
  return row == kFormats.end() ? std::nullopt : std::optional(row->format);
}

std::span<const std::string_view> output_format_names() {
  return kNames;
}

std::optional<std::int64_t> source_date_epoch() {
  const char* text = std::getenv("SOURCE_DATE_EPOCH");
  if (text == nullptr || *text == '\0') return std::nullopt;
  const char* end = text + std::string_view(text).size();
  std::int64_t seconds = -1;
  const auto [rest, fault] = std::from_chars(text, end, seconds);
  if (fault != std::errc{} || rest != end || seconds < 0 || seconds > kLastSecond) {
    throw Error(ErrorCode::Usage,
                fmt::format("SOURCE_DATE_EPOCH: expected seconds since 1970, found '{}'", printable(text)));
  }
  return seconds;
}

void write_output(OutputFormat format, const Result& result, const WriteOptions& options, Sink& sink,
                  std::vector<Diagnostic>& notes) {
  const auto row = std::ranges::find(kFormats, format, &Row::format);
  if (row == kFormats.end() || row->writer == nullptr)
    throw Error(ErrorCode::Internal, "a picture is not written as text");
  row->writer(result, options, sink, notes);
}

std::string_view detail::type_name(const Curve& curve) {
  if (const auto* arc = std::get_if<CircularArc>(&curve)) return arc->full() ? "circle" : "arc";
  constexpr std::array<std::string_view, 4> names = {"line", "arc", "ellipse", "bspline"};
  return names[curve.index()];
}

}  // namespace meshcontour

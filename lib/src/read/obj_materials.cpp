#include "read/obj_materials.hpp"

#include <algorithm>
#include <cmath>

#include "base/text_cursor.hpp"

namespace meshcontour::detail {
namespace {

std::uint8_t channel(double fraction) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(fraction, 0.0, 1.0)));
}

void read_property(TextCursor& in, std::string_view keyword, Rgba& color) {
  if (keyword == "Kd" && in.peek() != "spectral" && in.peek() != "xyz") {
    color.red = channel(in.number());
    color.green = in.at_line_end() ? color.red : channel(in.number());
    color.blue = in.at_line_end() ? color.red : channel(in.number());
  } else if (keyword == "d" && in.peek() != "-halo") {
    color.alpha = channel(in.number());
  } else if (keyword == "Tr") {
    color.alpha = channel(1 - in.number());
  }
}

}  // namespace

void read_obj_materials(const InputFolder& folder, std::string_view file,
                        std::map<std::string, Rgba>& colors) {
  std::optional<InputFile> input = folder.open(file);
  if (!input) {
    throw Error(ErrorCode::NoInput, "'" + printable(file, 80) + "' does not exist");
  }
  const FileBytes bytes = input->read();
  TextCursor in(bytes.view(), input->name(), '#');
  Rgba* color = nullptr;
  while (!in.at_end()) {
    const std::string_view keyword = in.word();
    if (keyword == "newmtl") {
      color = &colors[std::string(in.rest_of_line())];
      continue;
    }
    if (color != nullptr) read_property(in, keyword, *color);
    in.rest_of_line();
  }
}

}  // namespace meshcontour::detail

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "meshcontour/units.hpp"
#include "render/layers.hpp"
#include "render/stroke_font.hpp"

namespace meshcontour::detail {
namespace {

using Eigen::Vector2d;

constexpr double kMargin = 18, kAxis = 38, kLetter = 11;  // pixels at a line scale of 1
constexpr float kLine = 1.6F;

// Small pictures have a smaller legend, that can still be read.
double legend_scale(const Drawing& drawing) {
  const int side = std::min(drawing.options.width, drawing.options.height);
  return drawing.line_scale * std::clamp(side / 360.0, 0.6, 1.0);
}

// Lines in pixels from the picture's lower left corner.
class PictureLines {
 public:
  explicit PictureLines(const Drawing& drawing) : drawing_(drawing), scale_(legend_scale(drawing)) {}

  void add(const Vector2d& from, const Vector2d& to, const Rgba& color) {
    for (const Vector2d& p : {from, to}) {
      vertices_.push_back(
          {.position = {static_cast<float>(p.x()), static_cast<float>(p.y()), 0}, .color = color});
    }
  }

  /// Centred about a point.
  void add_text(std::string_view text, const Vector2d& center, const Rgba& color) {
    const double height = kLetter * scale_;
    const Vector2d corner = center - height * Vector2d(text_width(text), 1) / 2;
    const auto ends = text_strokes(text);
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
      add(corner + height * ends[i], corner + height * ends[i + 1], color);
    }
  }

  void append_to(Scene& scene) {
    // Lines of two samples would fill small letters.
    Batch batch = make_batch(drawing_, Batch::Kind::Lines, drawing_.frames.size(),
                             scene.samples_across == 1 ? 1 : kLine);
    batch.bias = 0;
    append(scene, std::move(batch), vertices_);
  }

 private:
  const Drawing& drawing_;
  double scale_;
  std::vector<Vertex> vertices_;
};

// The largest of 1, 2 and 5 times a power of ten that is not above the length.
double round_length(double length) {
  const double power = std::pow(10, std::floor(std::log10(length)));
  for (const double step : {5.0, 2.0}) {
    if (step * power <= length) return step * power;
  }
  return power;
}

}  // namespace

void add_axes(const Drawing& drawing, Scene& scene) {
  PictureLines lines(drawing);
  const double scale = legend_scale(drawing), length = kAxis * scale, letter = kLetter * scale;
  const Vector2d origin = Vector2d::Constant(kMargin * scale + length);
  for (int i = 0; i < 3; ++i) {
    const Vector2d axis = drawing.camera.axes.block<2, 1>(0, i);
    const Rgba& color = drawing.palette.axes[static_cast<std::size_t>(i)];
    lines.add(origin, origin + length * axis, color);
    // An axis that points at the viewer has its letter beside the origin.
    const bool seen = axis.norm() > 0.2;
    const Vector2d end =
        seen ? Vector2d(length * axis + letter * axis.normalized()) : Vector2d(-letter, -letter);
    lines.add_text(std::string_view("XYZ").substr(static_cast<std::size_t>(i), 1), origin + end, color);
  }
  lines.append_to(scene);
}

void add_scale(const Drawing& drawing, Scene& scene) {
  const double pixels = drawing.camera.pixels_per_unit;
  const double length = round_length(0.25 * drawing.options.width / pixels);
  const double scale = legend_scale(drawing), margin = kMargin * scale, tick = 0.4 * kLetter * scale;
  const Vector2d right(drawing.options.width - margin, margin), left = right - Vector2d(length * pixels, 0);
  const Rgba& color = drawing.palette.scale;
  PictureLines lines(drawing);
  lines.add(left, right, color);
  for (const Vector2d& end : {left, right})
    lines.add(end - Vector2d(0, tick), end + Vector2d(0, tick), color);
  const std::string_view unit = unit_symbol(drawing.model.metres_per_unit);
  const std::string text = fmt::format("{:.15g}{}{}", length, unit.empty() ? "" : " ", unit);
  lines.add_text(text, (left + right) / 2 + Vector2d(0, 1.2 * kLetter * scale), color);
  lines.append_to(scene);
}

}  // namespace meshcontour::detail

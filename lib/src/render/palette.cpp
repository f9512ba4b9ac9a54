#include "render/palette.hpp"

#include <array>
#include <cmath>

namespace meshcontour {
namespace {

// Told apart also with the common colour deficiencies [Okabe & Ito 2008].
constexpr Rgba kOrange{230, 159, 0, 255}, kSkyBlue{86, 180, 233, 255}, kGreen{0, 158, 115, 255};
constexpr Rgba kYellow{240, 228, 66, 255}, kBlue{0, 114, 178, 255}, kVermilion{213, 94, 0, 255};
constexpr Rgba kPurple{204, 121, 167, 255};
constexpr Rgba kWhite{255, 255, 255, 255}, kBlack{0, 0, 0, 255};

struct TypeColor {
  Rgba operator()(const LineSegment&) const { return kBlue; }
  Rgba operator()(const CircularArc& arc) const { return arc.full() ? kGreen : kVermilion; }
  Rgba operator()(const EllipticalArc&) const { return kPurple; }
  Rgba operator()(const BSplineCurve&) const { return kOrange; }
};

bool is_dark(const std::optional<Rgba>& background) {
  if (!background || background->alpha < 128) return false;
  return 299 * background->red + 587 * background->green + 114 * background->blue < 110'000;
}

}  // namespace

Rgba patch_color(std::size_t patch) {
  constexpr std::array<Rgba, 7> hues = {kSkyBlue, kOrange, kGreen, kVermilion, kYellow, kPurple, kBlue};
  const Rgba& hue = hues[patch % hues.size()];
  switch (patch / hues.size() % 3) {
    case 1:
      return detail::mixed(hue, kWhite, 0.45);
    case 2:
      return detail::mixed(hue, kBlack, 0.35);
    default:
      return hue;
  }
}

Rgba patch_number_color(std::size_t patch) {
  constexpr std::size_t kNumbers = (1 << 24) - 1;
  const std::size_t number = patch % kNumbers + 1;
  const auto byte = [&](int shift) { return static_cast<std::uint8_t>(number >> shift & 255); };
  return {byte(16), byte(8), byte(0), 255};
}

Rgba type_color(const Curve& curve) {
  return std::visit(TypeColor{}, curve);
}

namespace detail {

Rgba mixed(const Rgba& color, const Rgba& other, double share) {
  const auto mix = [&](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(a + share * (b - a)));
  };
  return {mix(color.red, other.red), mix(color.green, other.green), mix(color.blue, other.blue), 255};
}

Palette make_palette(const RenderOptions& options) {
  constexpr Rgba red{255, 0, 0, 255}, magenta{255, 0, 255, 255};
  constexpr std::array<Rgba, 3> axes = {{{210, 40, 40, 255}, {30, 140, 60, 255}, {40, 80, 220, 255}}};
  if (options.view == View::Report)
    return {{230, 0, 0, 255}, red, magenta, red, red, kBlue, kGreen, kBlack, kGreen, kBlue, kBlack, axes};
  Palette palette{{200, 205, 212, 255}, {40, 40, 44, 255},   {214, 0, 110, 255}, {90, 96, 104, 255},
                  {0, 90, 200, 255},    {235, 125, 20, 255}, {0, 110, 60, 255},  {60, 60, 150, 255},
                  {0, 130, 90, 255},    {200, 30, 30, 255},  {40, 40, 44, 255},  axes};
  if (is_dark(options.background)) {
    for (Rgba* color : {&palette.edges, &palette.wireframe, &palette.scale})
      *color = mixed(*color, kWhite, 0.7);
    for (Rgba* color :
         {&palette.curves, &palette.points, &palette.control, &palette.knots, &palette.annotations,
          &palette.tree, &palette.path, &palette.axes[0], &palette.axes[1], &palette.axes[2]}) {
      *color = mixed(*color, kWhite, 0.4);
    }
  }
  return palette;
}

}  // namespace detail
}  // namespace meshcontour

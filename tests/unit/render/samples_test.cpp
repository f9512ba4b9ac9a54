// Samples a pixel, and pictures whose colours are labels.

#include <algorithm>
#include <set>

#include "meshcontour/fit.hpp"
#include "render/gl_module.hpp"
#include "render/scene_builder.hpp"
#include "solids.hpp"
#include "support/catch.hpp"
#include "support/pictures.hpp"

using namespace meshcontour;
using namespace solids;

namespace {

constexpr Rgba kWhite{255, 255, 255, 255};

using Colors = std::set<std::array<int, 4>>;

std::array<int, 4> channels(const Rgba& color) {
  return {color.red, color.green, color.blue, color.alpha};
}

Colors colors_of(const Image& image) {
  Colors colors;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    colors.insert({image.rgba[i], image.rgba[i + 1], image.rgba[i + 2], image.rgba[i + 3]});
  }
  return colors;
}

Colors colors_of(std::initializer_list<Rgba> list) {
  Colors colors;
  for (const Rgba& color : list) colors.insert(channels(color));
  return colors;
}

RenderOptions of_samples(int samples, int scale = 1) {
  RenderOptions options;
  options.width = 150 * scale;
  options.height = 110 * scale;
  options.samples = samples;
  for (const Layer layer : {Layer::Edges, Layer::Points, Layer::Wireframe}) {
    options.styles.push_back({layer, std::nullopt, 1.5 * scale});
  }
  return options;
}

// Each pixel the rounded mean of a square.
Image reduced(const Image& image, int across) {
  Image small{image.width / across, image.height / across, {}};
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      std::array<int, 4> sum{};
      for (int k = 0; k < across * across; ++k) {
        const auto sample = channels(pixel(image, across * x + k % across, across * y + k / across));
        for (std::size_t c = 0; c < 4; ++c) sum[c] += sample[c];
      }
      const int count = across * across;
      for (const int channel : sum)
        small.rgba.push_back(static_cast<std::uint8_t>((channel + count / 2) / count));
    }
  }
  return small;
}

Model solid() {
  return placed({cylinder(34, 10, 15), box({12, -3, 0}, {20, 6, 9}, {90, 160, 220, 255})});
}

Image tiled(const Model& model, const RenderOptions& options, int largest_tile) {
  std::string failure;
  const detail::GlApi* api = detail::load_gl_module(GlBackend::OSMesa, failure);
  if (api == nullptr) api = detail::load_gl_module(GlBackend::Egl, failure);
  REQUIRE(api != nullptr);
  std::vector<Diagnostic> diagnostics;
  const auto boundaries = extract_boundaries(model, {}, diagnostics);
  detail::Scene scene = detail::build_scene(model, boundaries, {}, options);
  detail::GlSettings settings;
  settings.largest_tile = largest_tile;
  Image image;
  REQUIRE(api->draw(scene, settings, image).status == detail::GlOutcome::Status::Done);
  return image;
}

// Rows of the middle column that are not white.
int rows_in_the_middle(const Image& image) {
  int rows = 0;
  for (int y = 0; y < image.height; ++y) rows += pixel(image, image.width / 2, y) != kWhite;
  return rows;
}

}  // namespace

TEST_CASE("samples: a picture of 4 or 16 is the mean of one so much larger with 1", "[render][samples]") {
  const int across = GENERATE(2, 4);
  const auto layers = GENERATE(std::vector{Layer::Mesh}, std::vector{Layer::Edges},
                               std::vector{Layer::Mesh, Layer::Wireframe, Layer::Edges, Layer::Points});
  RenderOptions small = of_samples(across * across), large = of_samples(1, across);
  small.layers = large.layers = layers;
  const Model model = solid();
  const Image expected = reduced(picture(model, large), across);
  CHECK(pictures::differing_share(picture(model, small), expected, 0) == 0);
  CHECK(pictures::differing_share(picture(model, of_samples(1)), expected, 0) > 0.001);
}

TEST_CASE("samples: lines and points are as wide with any number of them", "[render][samples]") {
  const Model model = placed({rectangle({-5, -5, 0}, {5, 5, 0}, kWhite)});
  RenderOptions options = of_samples(GENERATE(1, 4, 16));
  options.width = 100;
  options.view = View::Front;  // along the plane: a line
  const Layer layer = GENERATE(Layer::Edges, Layer::Wireframe);
  options.layers = {layer};
  for (const int width : {1, 2, 5, 20}) {
    options.styles = {{layer, Rgba{0, 0, 0, 255}, width}};
    CAPTURE(options.samples, width);
    const int rows = rows_in_the_middle(picture(model, options));
    CHECK(rows >= width);
    CHECK(rows <= width + (options.samples > 1));  // partly covered at both ends
  }
}

TEST_CASE("samples: tiles of any size are parts of one picture", "[render][samples]") {
  RenderOptions options = of_samples(GENERATE(1, 16));
  options.layers = {Layer::Mesh, Layer::Edges, Layer::Points};
  const Model model = solid();
  const Image whole = picture(model, options);
  for (const int largest_tile : {60, 131, 250}) {
    CAPTURE(options.samples, largest_tile);
    CHECK(pictures::differing_share(tiled(model, options, largest_tile), whole, 3) <= 0.001);
  }
}

TEST_CASE("labels: one sample without shading has the palette's colours and no others", "[render][samples]") {
  const Model model = placed({cylinder(34, 10, 15)});  // side, bottom, top
  RenderOptions options = of_samples(1);
  options.color_by = ColorBy::Patch;
  options.shading = Shading::None;
  options.layers = {Layer::Mesh};
  // The bottom may show in samples right on its rim, where it is as near as the side.
  const Colors all = colors_of({kWhite, patch_color(0), patch_color(1), patch_color(2)});
  const Image whole = picture(model, options), parts = tiled(model, options, 64);
  for (const Image* image : {&whole, &parts}) {
    const Colors colors = colors_of(*image);
    CHECK(std::ranges::includes(all, colors));
    CHECK(std::ranges::includes(colors, colors_of({kWhite, patch_color(0), patch_color(2)})));
  }
  options.view = View::Bottom;
  options.background = Rgba{1, 2, 3, 255};
  CHECK(colors_of(picture(model, options)) == colors_of({*options.background, patch_color(1)}));
  SECTION("shading and averages add others") {
    options.view = View::Iso;
    options.samples = 4;
    CHECK(colors_of(picture(model, options)).size() > 3);
    options.samples = 1;
    options.shading = Shading::Smooth;
    CHECK(colors_of(picture(model, options)).size() > 3);
  }
}

// A model with its loops and curves.
struct FittedCylinder {
  Model model = placed({cylinder(34, 10, 15)});
  std::vector<Diagnostic> diagnostics;
  std::vector<ShellBoundary> boundaries = extract_boundaries(model, {}, diagnostics);
  std::vector<Contour> contours = fit_contours(model, boundaries, {}, diagnostics);
};

TEST_CASE("labels: every layer keeps its colours with one sample", "[render][samples]") {
  const FittedCylinder fitted;
  RenderOptions options = of_samples(1);
  options.shading = Shading::None;
  options.background.reset();
  int level = 0;
  Colors expected = {{0, 0, 0, 0}};
  for (const Layer layer : {Layer::Mesh, Layer::Wireframe, Layer::Edges, Layer::Curves, Layer::Control,
                            Layer::Points, Layer::Axes, Layer::Scale}) {
    level += 25;
    const Rgba color{static_cast<std::uint8_t>(level), static_cast<std::uint8_t>(255 - level), 77, 255};
    options.layers.push_back(layer);
    options.styles.push_back({layer, color, std::nullopt});
    expected.insert(channels(color));
  }
  options.layers.erase(options.layers.begin(), options.layers.begin() + 3);  // the default
  CHECK(colors_of(render(fitted.model, fitted.boundaries, fitted.contours, options)) == expected);
}

TEST_CASE("labels: an edge that patches share has the colour of one of them all along", "[render][samples]") {
  const FittedCylinder fitted;
  RenderOptions options = of_samples(1);
  options.color_by = GENERATE(ColorBy::Patch, ColorBy::Number);
  options.layers = {GENERATE(Layer::Edges, Layer::Curves)};
  CHECK(colors_of(render(fitted.model, fitted.boundaries, fitted.contours, options)).size() == 2);
  options.layers = {Layer::Wireframe};
  const Colors wires = colors_of(picture(fitted.model, options));
  CHECK(wires.size() == 4);
  if (options.color_by == ColorBy::Number)
    CHECK(wires == Colors{channels(kWhite), {0, 0, 1, 255}, {0, 0, 2, 255}, {0, 0, 3, 255}});
}

TEST_CASE("labels: numbers count the patches of all shells", "[render][samples]") {
  const Model model = solid();  // patches 1 to 3, and 4 to 9
  RenderOptions options = of_samples(GENERATE(1, 4));
  options.color_by = ColorBy::Number;
  options.layers = GENERATE(std::vector{Layer::Mesh}, std::vector{Layer::Mesh, Layer::Edges});
  options.background = Rgba{0, 0, 0, 255};
  // The box's sides in the order of its patches: below, above, front, back, left, right.
  options.view = View::Top;
  CHECK(colors_of(picture(model, options)).contains({0, 0, 3, 255}));
  options.view = View::Iso;
  const Colors colors = colors_of(picture(model, options));
  for (const int seen : {0, 1, 3, 5, 6, 9}) CHECK(colors.contains({0, 0, seen, 255}));
  for (const auto& color : colors) CHECK((color[0] == 0 && color[1] == 0 && color[2] <= 9));
  CHECK(patch_number_color(0) == Rgba{0, 0, 1, 255});
  CHECK(patch_number_color(0x0a0b0c) == Rgba{0x0a, 0x0b, 0x0d, 255});
  CHECK(patch_number_color(0xfffffe) == Rgba{255, 255, 255, 255});
  CHECK(patch_number_color(0xffffff) == Rgba{0, 0, 1, 255});
}

TEST_CASE("samples: other numbers than 1, 4 and 16 are refused", "[render][samples][error]") {
  RenderOptions options = of_samples(GENERATE(0, -1, 2, 3, 9, 17, 64));
  CHECK_THROWS_WITH(picture(solid(), options), Catch::Contains("1, 4 or 16"));
}

// Only the part of a picture that something is drawn in is rasterized; nobody can tell.

#include <algorithm>

#include "solids.hpp"
#include "support/catch.hpp"
#include "support/pictures.hpp"

using namespace meshcontour;
using namespace solids;

namespace {

constexpr Rgba kGrey{150, 150, 150, 255};

// The report's view stands still: its middle is the origin, 71 model units below the picture's upper end.
RenderOptions report(std::vector<Layer> layers) {
  RenderOptions options;
  options.width = options.height = 300;
  options.view = View::Report;
  options.layers = std::move(layers);
  options.styles = {{Layer::Wireframe, std::nullopt, 9.0}, {Layer::Points, std::nullopt, 20.0}};
  return options;
}

// In the report's picture: half its height to the right, up and towards the viewer.
Point seen_at(double right, double up, double near = 0) {
  return view_axes(View::Report).transpose() * (71.4 * Vector(right, up, near));
}

// Along the axes of the picture but for a turn: on an upright edge a rounding decides over whole columns.
Model small_box(const Point& at, double half = 4, double half_depth = 4) {
  const Vector size(half, half, half_depth);
  Model model = placed({box(-size, size, kGrey)});
  model.instances[0].placement = Eigen::Translation3d(at) *
                                 Eigen::Affine3d(view_axes(View::Report).transpose()) *
                                 Eigen::AngleAxisd(0.2, Vector(1, 2, 3).normalized());
  return model;
}

// Lines of another colour in two corners: the region is the whole picture, and depth decides.
Model with_corners(Model model) {
  for (const double side : {-1.0, 1.0}) {
    model.annotations.push_back({"", {seen_at(0.98 * side, 0.98 * side), seen_at(0.99 * side, 0.99 * side)}});
  }
  return model;
}

// White where the corners' lines are.
Image without_corners(Image image) {
  constexpr int kCorner = 12;
  const auto wipe = [&](int x, int y) {
    const auto pixel = static_cast<std::size_t>(y * image.width + x);
    std::fill_n(image.rgba.begin() + static_cast<std::ptrdiff_t>(4 * pixel), 4, std::uint8_t{255});
  };
  for (int y = 0; y < kCorner; ++y) {
    for (int x = 0; x < kCorner; ++x) {
      wipe(image.width - 1 - x, y);
      wipe(x, image.height - 1 - y);
    }
  }
  return image;
}

// But for samples on the rim of something, whose side is a matter of rounding.
bool alike(const Image& a, const Image& b) {
  return pictures::differing_share(a, b, 80) <= 0.0003;
}

}  // namespace

TEST_CASE("drawn region: nothing is cut off, wherever it is and however wide its lines", "[render][region]") {
  RenderOptions options =
      report(GENERATE(std::vector{Layer::Wireframe}, std::vector{Layer::Points}, std::vector{Layer::Mesh}));
  options.samples = GENERATE(1, 4);
  // Inside, across the picture's ends, nearer, and from far to behind the viewer.
  const auto at = GENERATE(std::array{0.0, 0.0, 0.0, 4.0}, std::array{-0.6, 0.55, 0.0, 4.0},
                           std::array{0.98, 0.3, 0.0, 4.0}, std::array{0.2, -0.99, 0.0, 4.0},
                           std::array{-0.3, -0.35, 1.5, 4.0}, std::array{0.25, 0.3, 2.6, 190.0});
  CAPTURE(options.samples, at[0], at[1], at[2], at[3]);
  const Model model = small_box(seen_at(at[0], at[1], at[2]), 4, at[3]);
  const Image image = picture(model, options);
  options.layers.push_back(Layer::Annotations);
  const Image whole = without_corners(picture(with_corners(model), options));
  CHECK(alike(without_corners(image), whole));
}

TEST_CASE("drawn region: many placements are all in it", "[render][region]") {
  Model model = small_box(Point::Zero(), 0.5, 0.5);
  model.instances.clear();
  for (int i = 0; i < 50; ++i) {
    Instance instance;
    instance.placement = Eigen::Translation3d(seen_at(-0.9 + 0.035 * i, 0.8 - 0.03 * i));
    model.instances.push_back(instance);
  }
  const Image image = picture(model, report({Layer::Mesh}));
  const Image whole = picture(with_corners(model), report({Layer::Mesh, Layer::Annotations}));
  CHECK(alike(without_corners(image), without_corners(whole)));
  CHECK(pixel(image, 15, 30) != Rgba{255, 255, 255, 255});
}

TEST_CASE("drawn region: the legend outside of it changes nothing else", "[render][region]") {
  RenderOptions options;
  options.width = 600;
  options.height = 200;
  const Model model = placed({cylinder(34, 10, 15)});  // seen in the middle third
  const Image alone = picture(model, options);
  options.layers.push_back(Layer::Axes);
  const Image both = picture(model, options);
  const auto columns = [&](const Image& image, int first, int end) {
    Image part{end - first, image.height, {}};
    for (int y = 0; y < image.height; ++y) {
      const auto row = image.rgba.begin() + 4 * std::ptrdiff_t(y) * image.width;
      part.rgba.insert(part.rgba.end(), row + 4 * first, row + 4 * end);
    }
    return part;
  };
  CHECK(alike(columns(alone, 150, 600), columns(both, 150, 600)));
  CHECK_FALSE(alike(columns(alone, 0, 150), columns(both, 0, 150)));
}

TEST_CASE("drawn region: the background is one colour, rasterized or not", "[render][region]") {
  RenderOptions options;
  options.width = 900;
  options.height = 150;
  options.samples = GENERATE(1, 4, 16);
  options.background =
      GENERATE(Rgba{10, 200, 90, 255}, Rgba{10, 200, 90, 128}, Rgba{250, 3, 77, 1}, Rgba{9, 9, 9, 0});
  const Image image = picture(placed({cylinder(34, 10, 15)}), options);
  const Rgba corner = pixel(image, 0, 0);
  CHECK(corner.alpha == options.background->alpha);
  for (int x = 0; x < 350; ++x) {
    for (const int y : {0, 75, 149}) {
      if (pixel(image, x, y) != corner) FAIL("another colour at " << x << ", " << y);
    }
  }
}

#include "meshcontour/render.hpp"

#include <algorithm>
#include <cstdlib>

#include "meshcontour/fit.hpp"
#include "render/gl_module.hpp"
#include "render/scene_builder.hpp"
#include "solids.hpp"
#include "support/catch.hpp"
#include "support/pictures.hpp"

using namespace meshcontour;
using namespace solids;

namespace {

constexpr Rgba kWhite{255, 255, 255, 255}, kRed{230, 30, 30, 255}, kGreen{30, 200, 30, 255},
    kBlue{30, 30, 230, 255};

RenderOptions small(std::vector<Layer> layers, View view = View::Iso) {
  RenderOptions options;
  options.width = 160;
  options.height = 120;
  options.layers = std::move(layers);
  options.view = view;
  return options;
}

bool is_like(const Rgba& pixel, const Rgba& color) {
  const auto leads = [](int a, int b, int c) { return a > 2 * b && a > 2 * c; };
  if (color == kRed) return leads(pixel.red, pixel.green, pixel.blue);
  if (color == kGreen) return leads(pixel.green, pixel.red, pixel.blue);
  return leads(pixel.blue, pixel.red, pixel.green);
}

// The middle of the pixels of a colour, y up.
Eigen::Vector2d middle_of(const Image& image, const Rgba& color) {
  return middle(image, [&](const Rgba& pixel) { return is_like(pixel, color); });
}

// Pixels that a layer changes.
double share_of(const Model& model, Layer layer, std::vector<Layer> below, View view, int samples = 4) {
  RenderOptions options = small(below, view);
  options.samples = samples;
  const auto pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  Image without{options.width, options.height, std::vector<std::uint8_t>(4 * pixels, 255)};
  if (!below.empty()) without = picture(model, options);
  options.layers.push_back(layer);
  const int levels = samples == 16 ? 2 : 10;  // a sample's share of a pixel counts
  return pictures::differing_share(without, picture(model, options), levels);
}

Model moved(Model model, const Eigen::Affine3d& placement) {
  for (Instance& instance : model.instances) instance.placement = placement * instance.placement;
  return model;
}

// Contours as the file's loops; the fit has tests of its own.
std::vector<Contour> contours_of(const Model& model) {
  std::vector<Diagnostic> diagnostics;
  const auto boundaries = extract_boundaries(model, {}, diagnostics);
  return fit_contours(model, boundaries, {}, diagnostics);
}

}  // namespace

TEST_CASE("render: a cylinder fills the picture but for a margin, on the background", "[render]") {
  const Image image =
      picture(placed({cylinder(34, 10, 15)}), small({Layer::Mesh, Layer::Edges}, View::Front));
  REQUIRE(image.rgba.size() == 4 * 160 * 120);
  CHECK(pixel(image, 2, 2) == kWhite);
  CHECK(is_like(pixel(image, 80, 60), kRed));
  CHECK(pixel(image, 80, 3) == kWhite);
  CHECK(pixel(image, 80, 12) != kWhite);
}

TEST_CASE("render: each view has its axes where CAD has them", "[render]") {
  // Red lies towards +X, green towards +Y, blue towards +Z of the grey middle.
  const Model model = placed({box({-1, -1, -1}, {1, 1, 1}, {}), box({4, -1, -1}, {6, 1, 1}, kRed),
                              box({-1, 4, -1}, {1, 6, 1}, kGreen), box({-1, -1, 4}, {1, 1, 6}, kBlue)});
  struct Case {
    View view;
    Rgba right, up;
    bool rightwards, upwards;
  };
  const Case one =
      GENERATE(Case{View::Front, kRed, kBlue, true, true}, Case{View::Back, kRed, kBlue, false, true},
               Case{View::Right, kGreen, kBlue, true, true}, Case{View::Left, kGreen, kBlue, false, true},
               Case{View::Top, kRed, kGreen, true, true}, Case{View::Bottom, kRed, kGreen, true, false});
  const Image image = picture(model, small({Layer::Mesh}, one.view));
  const Eigen::Vector2d right = middle_of(image, one.right), up = middle_of(image, one.up);
  CHECK((right.x() > up.x()) == one.rightwards);
  CHECK((up.y() > right.y()) == one.upwards);
  const Eigen::Matrix3d axes = view_axes(one.view);
  CHECK((axes * axes.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-15);
  CHECK(axes.determinant() == Approx(1));
}

TEST_CASE("render: iso shows the front, the right and the top", "[render]") {
  CHECK((view_axes(View::Iso).row(2).transpose() - Vector(1, -1, 1).normalized()).norm() < 1e-15);
  CHECK(view_axes(View::Iso).row(1).z() > 0.8);
}

TEST_CASE("render: another axis than Z can point up", "[render]") {
  const UpAxis up = GENERATE(UpAxis::X, UpAxis::Y, UpAxis::Z);
  const Vector axis = up == UpAxis::X ? Vector::UnitX() : up == UpAxis::Y ? Vector::UnitY() : Vector::UnitZ();
  for (const View view : {View::Front, View::Back, View::Left, View::Right}) {
    CHECK(view_axes(view, up).row(1).transpose() == axis);
    CHECK(view_axes(view, up).determinant() == Approx(1));
  }
  CHECK(view_axes(View::Top, up).row(2).transpose() == axis);
  CHECK(view_axes(View::Report, up) == view_axes(View::Report));
  // Where Y points up, Z points at the viewer of the front, as graphics programs have it.
  CHECK(view_axes(View::Front, UpAxis::Y).row(2).transpose() == Vector(Vector::UnitZ()));
}

TEST_CASE("render: the report's view is its perspective, in model units", "[render]") {
  // The origin is in the middle; a unit there is tan(75 deg) / 4 * 0.015 half heights.
  RenderOptions options = small({Layer::Mesh}, View::Report);
  options.width = options.height = 500;
  const Image image = picture(placed({box({-10, -10, -10}, {10, 10, 10}, kBlue)}), options);
  CHECK(is_like(pixel(image, 250, 250), kRed));
  const Eigen::Vector2d center = middle_of(image, kRed);
  CHECK(center.x() == Approx(250).margin(4));
  CHECK(center.y() == Approx(250).margin(4));
  const Eigen::Matrix3d axes = view_axes(View::Report);
  const Vector diagonal = Vector(1, 1, -1).normalized();
  CHECK((axes * diagonal - diagonal).norm() < 1e-15);
  CHECK(axes.trace() == Approx(1 + 2 * std::cos(std::numbers::pi / 4)));
}

TEST_CASE("render: hidden edges do not shine through faces", "[render]") {
  // A thin plate hides a box behind it; seen from the top and at an angle.
  const View view = GENERATE(View::Top, View::Iso, View::Bottom);
  const double side = view == View::Bottom ? -1 : 1;
  const Shell plate = box({-10, -10, side * 1 - 0.02}, {10, 10, side * 1 + 0.02}, kRed);
  const Model alone = placed({plate});
  Model both = placed({plate, box({-2, -2, side * 0.2}, {2, 2, side * 0.6}, kBlue)});
  const auto layers =
      GENERATE(std::vector{Layer::Mesh, Layer::Edges}, std::vector{Layer::Mesh, Layer::Wireframe});
  CHECK(pictures::differing_share(picture(alone, small(layers, view)), picture(both, small(layers, view)),
                                  3) == 0);
}

TEST_CASE("render: faces do not eat their edges, at any angle", "[render]") {
  const double angle = GENERATE(0.0, 20.0, 45.0, 70.0, 85.0) * std::numbers::pi / 180;
  const double turn = GENERATE(0.0, 0.5, 1.2);
  const int samples = GENERATE(1, 4, 16);
  Model model = placed({rectangle({-5, -5, 0}, {5, 5, 0}, kWhite)});
  model.instances[0].placement =
      Eigen::AngleAxisd(angle, Vector::UnitX()) * Eigen::AngleAxisd(turn, Vector::UnitZ());
  const double alone = share_of(model, Layer::Edges, {}, View::Top, samples);
  CAPTURE(angle, turn, samples);
  CHECK(alone > 0.01);
  CHECK(share_of(model, Layer::Edges, {Layer::Mesh}, View::Top, samples) >= 0.97 * alone);
}

TEST_CASE("render: a mirrored instance is lit like a mirrored shape", "[render]") {
  const Shell shell = cylinder(34, 3, 8);
  Model instanced = placed({shell});
  instanced.instances[0].placement.linear() = Vector(-1, 1, 1).asDiagonal();
  Shell mirrored = shell;
  for (Point& p : mirrored.points) p.x() = -p.x();
  for (Triangle& t : mirrored.triangles) std::swap(t[1], t[2]);
  const auto options = small({Layer::Mesh, Layer::Edges});
  CHECK(pictures::differing_share(picture(instanced, options), picture(placed({mirrored}), options), 2) <
        0.001);
}

TEST_CASE("render: far from the origin, tiny or huge, the picture is the same", "[render]") {
  const Model model = placed({cylinder(34, 10, 25)});
  const auto options = small({Layer::Mesh, Layer::Edges, Layer::Curves});
  const Image reference = picture(model, options, contours_of(model));
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();
  SECTION("shifted by a placement") {
    placement.translation() = GENERATE(1e6, 1e8) * Vector(1, -2, 3);
  }
  SECTION("scaled by a placement") {
    placement.linear() *= GENERATE(1e-9, 1e-3, 1e6, 1e100);
  }
  const Model other = moved(model, placement);
  CHECK(pictures::differing_share(picture(other, options, contours_of(model)), reference, 3) < 0.002);
}

TEST_CASE("render: points far from the origin keep their shape", "[render]") {
  const Model model = placed({cylinder(34, 10, 25)});
  const auto options = small({Layer::Mesh, Layer::Edges, Layer::Curves});
  const Image reference = picture(model, options, contours_of(model));
  Model shifted = model;
  const double offset = GENERATE(1e6, 1e8);
  for (Point& p : shifted.shells[0].points) p += offset * Vector(1, -2, 3);
  CHECK(pictures::differing_share(picture(shifted, options, contours_of(shifted)), reference, 3) < 0.002);
}

TEST_CASE("render: flat models, and models that are a point, are pictures", "[render]") {
  const Model flat = placed({rectangle({0, 0, 0}, {4, 3, 0}, kRed)});
  CHECK_NOTHROW(picture(flat, small({Layer::Mesh})));
  CHECK_NOTHROW(picture(flat, small({Layer::Edges}, View::Front)));  // seen along the plane: a line
  const Model point = placed({rectangle({7, 7, 7}, {7, 7, 7}, kRed)});
  CHECK_THROWS_AS(picture(point, small({Layer::Mesh})), Error);
  CHECK_FALSE(picture(point, small({Layer::Wireframe, Layer::Points})).rgba.empty());
}

TEST_CASE("render: without background alpha is straight", "[render]") {
  RenderOptions options = small({Layer::Mesh, Layer::Edges});
  const Model model = placed({cylinder(34, 10, 25)});
  const Image white = picture(model, options);
  options.background.reset();
  const Image image = picture(model, options);
  CHECK(pixel(image, 1, 1) == Rgba{0, 0, 0, 0});
  CHECK(pixel(image, 80, 60).alpha == 255);
  std::size_t partly = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const int alpha = image.rgba[i + 3];
    partly += alpha > 0 && alpha < 255;
    for (std::size_t c = 0; c < 3; ++c) {
      const int over_white = (image.rgba[i + c] * alpha + 255 * (255 - alpha) + 127) / 255;
      if (std::abs(over_white - white.rgba[i + c]) > 2)
        FAIL("pixel " << i / 4 << " is not its own colour over white: " << int(image.rgba[i + c]) << " "
                      << alpha << " " << int(white.rgba[i + c]));
    }
  }
  CHECK(partly > 50);
}

TEST_CASE("render: a translucent background has its own colour and alpha", "[render]") {
  RenderOptions options = small({Layer::Mesh});
  options.background = Rgba{200, 100, 50, 128};
  const Rgba corner = pixel(picture(placed({cylinder(8, 1, 1)}), options), 1, 1);
  CHECK(corner.alpha == 128);
  CHECK(std::abs(corner.red - 200) <= 1);
  CHECK(std::abs(corner.green - 100) <= 1);
  CHECK(std::abs(corner.blue - 50) <= 1);
}

TEST_CASE("render: a picture in which nothing shows is refused", "[render]") {
  const Model model = placed({cylinder(8, 1, 1)});
  const Model away = moved(model, Eigen::Affine3d(Eigen::Translation3d(1e4, 0, 0)));
  CHECK_THROWS_WITH(picture(model, small({Layer::Annotations})), Catch::Contains("nothing to draw"));
  CHECK_THROWS_WITH(picture(away, small({Layer::Mesh}, View::Report)), Catch::Contains("outside the view"));
}

TEST_CASE("render: the same call gives the same bytes", "[render]") {
  const Model model = placed({cylinder(34, 10, 25)});
  RenderOptions options = small({Layer::Mesh, Layer::Edges, Layer::Curves, Layer::Points, Layer::Control});
  const auto contours = contours_of(model);
  const Image first = picture(model, options, contours);
  options.threads = GENERATE(1U, 2U, 5U);
  CHECK(pictures::differing_share(picture(model, options, contours), first, 0) == 0);
}

TEST_CASE("render: a picture does not depend on those before it", "[render]") {
  const Model model = placed({cylinder(34, 10, 25)});
  const auto contours = contours_of(model);
  const RenderOptions options = small({Layer::Mesh, Layer::Edges, Layer::Curves, Layer::Points});
  const Image first = picture(model, options, contours);
  RenderOptions other =
      small(GENERATE(std::vector{Layer::Points}, std::vector{Layer::Wireframe, Layer::Control}));
  other.width = GENERATE(160, 50);
  other.background.reset();
  picture(placed({rectangle({0, 0, 0}, {1, 1, 0}, kRed)}), other);
  CHECK(pictures::differing_share(picture(model, options, contours), first, 0) == 0);
}

TEST_CASE("render: OSMesa and EGL give one picture", "[render]") {
  const Model model = placed({cylinder(34, 10, 25)});
  RenderOptions options = small({Layer::Mesh, Layer::Edges, Layer::Curves, Layer::Points});
  options.backend = GlBackend::OSMesa;
  const Image first = picture(model, options, contours_of(model));
  options.backend = GlBackend::Egl;
  CHECK(pictures::differing_share(first, picture(model, options, contours_of(model)), 3) <= 0.001);
}

TEST_CASE("render: a size out of range is refused", "[render][error]") {
  RenderOptions options = small({Layer::Mesh});
  options.width = GENERATE(0, -1, 16385);
  const Model model = placed({cylinder(8, 1, 1)});
  CHECK_THROWS_WITH(picture(model, options), Catch::Contains("both must be 1 to 16384"));
}

TEST_CASE("render: any size in range is drawn to its last pixel", "[render]") {
  RenderOptions options = small({Layer::Mesh}, View::Top);
  options.width = GENERATE(1, 2, 3, 101);
  options.height = GENERATE(1, 5, 64);
  const Image image = picture(placed({rectangle({0, 0, 0}, {1, 1, 0}, kRed)}), options);
  CHECK(image.rgba.size() == 4 * std::size_t(options.width) * std::size_t(options.height));
  const Rgba center = pixel(image, options.width / 2, options.height / 2);
  CAPTURE(options.width, options.height, int(center.red), int(center.green), int(center.blue));
  CHECK(center.red > center.green + 50);  // partly covered where the picture is a pixel wide
}

TEST_CASE("render: a picture drawn in tiles shows no seam", "[render]") {
  const Model model = placed({cylinder(34, 10, 15)});
  std::vector<Diagnostic> diagnostics;
  const auto boundaries = extract_boundaries(model, {}, diagnostics);
  const auto contours = contours_of(model);
  const RenderOptions options = small({Layer::Mesh, Layer::Edges, Layer::Curves, Layer::Points});
  const Image whole = render(model, boundaries, contours, options);
  std::string failure;
  const detail::GlApi* api = detail::load_gl_module(GlBackend::OSMesa, failure);
  if (api == nullptr) api = detail::load_gl_module(GlBackend::Egl, failure);
  REQUIRE(api != nullptr);
  for (const int largest_tile : {64, 130, 250}) {
    detail::Scene scene = detail::build_scene(model, boundaries, contours, options);
    detail::GlSettings settings;
    settings.largest_tile = largest_tile;
    Image tiled;
    REQUIRE(api->draw(scene, settings, tiled).status == detail::GlOutcome::Status::Done);
    CAPTURE(largest_tile);
    CHECK(pictures::differing_share(tiled, whole, 3) <= 0.001);
  }
}

TEST_CASE("render: coordinates beyond reason are refused, not drawn as something else", "[render][error]") {
  const Model model = placed({rectangle({-1e200, -1e200, 0}, {1e200, 1e200, 0}, kRed)});
  CHECK_THROWS_WITH(picture(model, small({Layer::Mesh})), Catch::Contains("too large to be drawn"));
}

TEST_CASE("render: sharp edges inside a patch are drawn with the edges", "[render]") {
  Model model = placed({rectangle({-5, -5, 0}, {5, 5, 0}, kWhite)});
  const double without = share_of(model, Layer::Edges, {}, View::Top);
  model.shells[0].creases = {{0, 2}};
  CHECK(share_of(model, Layer::Edges, {}, View::Top) > 1.2 * without);
}

TEST_CASE("render: a face towards the viewer is lit by the light's cosine, on either side", "[render]") {
  const double cosine = 1 / Vector(-0.25, 0.35, 1).norm();
  const int expected = static_cast<int>(std::lround(255 * (0.36 + 0.64 * cosine)));
  Model model = placed({rectangle({-5, -5, 0}, {5, 5, 0}, kWhite)});
  const View view = GENERATE(View::Top, View::Bottom, View::Report);
  RenderOptions options = small({Layer::Mesh}, view);
  options.color_by = ColorBy::File;
  if (view == View::Report) model.instances[0].placement = view_axes(view).transpose();
  SECTION("as it is") {}
  SECTION("stretched and mirrored") {
    model.instances[0].placement.linear() *= Vector(-3, 2, 0.01).asDiagonal();
  }
  SECTION("flattened") {
    model.instances[0].placement.linear() *= Vector(1, 1, 0).asDiagonal();
  }
  SECTION("seen from behind") {
    model.instances[0].placement.linear() *= Vector(1, -1, -1).asDiagonal();
  }
  const Rgba color = pixel(picture(model, options), 80, 60);
  const int red =
      view == View::Report ? static_cast<int>(std::lround(230 / 255.0 * expected)) : expected;  // its own
  CHECK(std::abs(color.red - red) <= 1);
}

TEST_CASE("render: a slanting face is lit by the angle of its normal", "[render]") {
  const Vector light = Vector(-0.25, 0.35, 1).normalized();
  Model model = placed({rectangle({-5, -5, 0}, {5, 5, 0}, kWhite)});
  const double angle = GENERATE(-1.0, -0.5, 0.4, 1.1);
  model.instances[0].placement = Eigen::AngleAxisd(angle, Vector(1, 2, 0).normalized());
  const double cosine = (model.instances[0].placement.linear() * Vector::UnitZ()).dot(light);
  const int expected = static_cast<int>(std::lround(255 * (0.36 + 0.64 * std::max(cosine, 0.0))));
  CHECK(std::abs(pixel(picture(model, small({Layer::Mesh}, View::Top)), 80, 60).red - expected) <= 1);
}

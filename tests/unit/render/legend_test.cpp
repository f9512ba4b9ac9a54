#include <algorithm>

#include "render/stroke_font.hpp"
#include "solids.hpp"
#include "support/catch.hpp"
#include "support/pictures.hpp"

using namespace meshcontour;
using namespace solids;

namespace {

constexpr Rgba kGrey{128, 128, 128, 255}, kInk{0, 0, 255, 255};

RenderOptions front(std::vector<Layer> layers) {
  RenderOptions options;
  options.width = 640;
  options.height = 480;
  options.layers = std::move(layers);
  options.view = View::Front;
  return options;
}

// The longest run of pixels in a row that the test holds of.
template <class Test>
int widest_row(const Image& image, Test test) {
  int widest = 0;
  for (int y = 0; y < image.height; ++y) {
    int run = 0;
    for (int x = 0; x < image.width; ++x) {
      run = test(pixel(image, x, y)) ? run + 1 : 0;
      widest = std::max(widest, run);
    }
  }
  return widest;
}

bool is_blue(const Rgba& c) {
  return c.blue > 2 * c.red && c.blue > 2 * c.green;
}
bool is_red(const Rgba& c) {
  return c.red > 2 * c.blue && c.red > 2 * c.green;
}
bool is_green(const Rgba& c) {
  return c.green > 2 * c.red && c.green > 1.5 * c.blue;
}
bool is_grey(const Rgba& c) {
  return c.red == c.green && c.green == c.blue && c.red < 250;
}

}  // namespace

TEST_CASE("legend: the scale's bar is a round length as long as it says", "[render][legend]") {
  RenderOptions options = front({Layer::Mesh, Layer::Scale});
  options.styles = {{Layer::Scale, kInk, std::nullopt}};
  // The largest of 1, 2 and 5 times a power of ten up to a quarter of the picture's width.
  for (const auto& [size, bar] : {std::pair{100.0, 20.0}, {1000.0, 200.0}, {0.004, 1e-3}, {40.0, 10.0}}) {
    const Image image = picture(placed({box(Point(0, 0, 0), Point(size, size, size), kGrey)}), options);
    const int model = widest_row(image, is_grey), line = widest_row(image, is_blue);
    INFO(size << ": " << model << " and " << line << " pixels");
    CHECK(line * size / model == Approx(bar).epsilon(0.02));
  }
}

TEST_CASE("legend: the axes point as the view says", "[render][legend]") {
  const Model model = placed({box(Point(0, 0, 0), Point(9, 9, 9), kGrey)});
  RenderOptions options = front({Layer::Mesh, Layer::Axes});
  const auto check_right_and_up = [&](auto right, auto up) {
    const Image image = picture(model, options);
    const Eigen::Vector2d across = middle(image, right), along = middle(image, up);
    REQUIRE_FALSE(across.isZero());
    REQUIRE_FALSE(along.isZero());
    CHECK(across.x() > along.x() + 5);
    CHECK(along.y() > across.y() + 5);
  };
  check_right_and_up(is_red, is_blue);  // x and z
  options.view = View::Top;
  check_right_and_up(is_red, is_green);  // x and y
  options.view = View::Right;
  check_right_and_up(is_green, is_blue);  // y and z
  options.view = View::Front;
  options.up = UpAxis::Y;
  check_right_and_up(is_red, is_green);
}

TEST_CASE("legend: it does not make a picture out of nothing", "[render][legend][error]") {
  const Model model = placed({cylinder(12, 10, 15)});
  CHECK_THROWS_WITH(picture(model, front({Layer::Axes, Layer::Scale})), Catch::Contains("blank"));
  RenderOptions far = front({Layer::Mesh, Layer::Axes});
  far.view = View::Report;
  CHECK_THROWS_WITH(
      picture(placed({box(Point(1e6, 1e6, 1e6), Point(1e6 + 1, 1e6 + 1, 1e6 + 1), kGrey)}), far),
      Catch::Contains("blank"));
  far.layers = {Layer::Mesh, Layer::Scale};
  CHECK_THROWS_WITH(picture(model, far), Catch::Contains("perspective"));
}

TEST_CASE("legend: tiles leave no seam in it", "[render][legend]") {
  RenderOptions options = front({Layer::Mesh, Layer::Axes, Layer::Scale});
  options.width = 9000;
  options.height = 120;
  options.styles = {{Layer::Scale, kInk, std::nullopt}};
  const Image image = picture(placed({box(Point(0, 0, 0), Point(750, 1, 10), kGrey)}), options);
  CHECK(widest_row(image, is_blue) * 750.0 / widest_row(image, is_grey) == Approx(200).epsilon(0.02));
}

TEST_CASE("styles: a layer takes its colour and width", "[render]") {
  const Model model = placed({cylinder(34, 10, 15)});
  RenderOptions options = front({Layer::Wireframe});
  const auto blue_share = [&] {
    const Image image = picture(model, options);
    int count = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) count += is_blue(pixel(image, x, y));
    }
    return count;
  };
  CHECK(blue_share() == 0);
  options.styles = {{Layer::Wireframe, kInk, 1.0}};
  const int narrow = blue_share();
  CHECK(narrow > 0);
  options.styles.push_back({Layer::Wireframe, std::nullopt, 4.0});
  CHECK(blue_share() > 2 * narrow);
  options.styles.push_back({Layer::Edges, Rgba{255, 0, 0, 255}, 9.0});  // of a layer that is not drawn
  CHECK(blue_share() > 2 * narrow);
  options.styles.push_back({Layer::Wireframe, std::nullopt, 65.0});
  CHECK_THROWS_WITH(picture(model, options), Catch::Contains("up to 64"));
}

TEST_CASE("strokes: texts are as wide as their letters, unknown ones leave a gap", "[render][legend]") {
  using detail::text_strokes;
  CHECK(text_strokes("").empty());
  CHECK(text_strokes("?").empty());
  CHECK(detail::text_width("20 mm") > detail::text_width("20"));
  for (const char letter : std::string("0123456789.-+cdefiklmntuXYZ")) {
    const auto ends = text_strokes(std::string(3, letter));
    INFO(letter);
    REQUIRE(ends.size() >= 6);
    REQUIRE(ends.size() % 6 == 0);
    for (const Eigen::Vector2d& end : ends) {
      CHECK((end.x() >= 0 && end.x() <= detail::text_width("000") + 1e-12 && end.y() >= 0 && end.y() <= 1));
    }
  }
}

#include "meshcontour/render.hpp"

#include "solids.hpp"
#include "support/catch.hpp"

using namespace meshcontour;
using namespace solids;

TEST_CASE("render: a cylinder fills the picture but for a margin, on the background", "[render]") {
  RenderOptions options;
  options.width = 160;
  options.height = 120;
  options.layers = {Layer::Mesh, Layer::Edges};
  options.view = View::Front;
  const Image image = picture(placed({cylinder(34, 10, 15)}), options);
  REQUIRE(image.rgba.size() == 4 * 160 * 120);
  CHECK(pixel(image, 2, 2) == Rgba{255, 255, 255, 255});
  const Rgba middle = pixel(image, 80, 60);
  CHECK(middle.red > 2 * middle.blue);  // the side's colour, lit
  CHECK(pixel(image, 80, 12).green < 160);
}

TEST_CASE("render: a size out of range is refused", "[render][error]") {
  RenderOptions options;
  options.width = GENERATE(0, -1, 16385);
  const Model model = placed({cylinder(8, 1, 1)});
  CHECK_THROWS_WITH(picture(model, options), Catch::Contains("both must be 1 to 16384"));
}

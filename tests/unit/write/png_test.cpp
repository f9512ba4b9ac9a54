#include "write/png.hpp"

#include "support/catch.hpp"
#include "support/pictures.hpp"

using namespace meshcontour;

namespace {

Image noise(int width, int height, bool opaque) {
  Image image{width, height, std::vector<std::uint8_t>(4 * std::size_t(width) * std::size_t(height))};
  std::uint32_t state = 1;
  for (std::uint8_t& byte : image.rgba) {
    state = state * 1664525U + 1013904223U;
    byte = std::uint8_t(state >> 24);
  }
  for (std::size_t i = 3; opaque && i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  return image;
}

}  // namespace

TEST_CASE("encode_png: an independent decoder gives the image back", "[write]") {
  const bool opaque = GENERATE(true, false);
  const int width = GENERATE(1, 2, 17, 256), height = GENERATE(1, 3, 64);
  const Image image = noise(width, height, opaque);
  const auto png = encode_png(image);
  const Image decoded = pictures::decode_png(png);
  CHECK(decoded.width == width);
  CHECK(decoded.height == height);
  CHECK(png[25] == (opaque ? 2 : 6));  // colour type: without alpha where there is none
  CHECK(decoded.rgba == image.rgba);
}

TEST_CASE("encode_png: the same image gives the same bytes", "[write]") {
  CHECK(encode_png(noise(64, 48, true)) == encode_png(noise(64, 48, true)));
}

TEST_CASE("encode_png: an image whose sizes do not match is refused", "[write][error]") {
  Image image = noise(4, 4, true);
  image.rgba.pop_back();
  CHECK_THROWS_AS(encode_png(image), Error);
  CHECK_THROWS_AS(encode_png(Image{}), Error);
}

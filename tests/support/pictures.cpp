#include "support/pictures.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace pictures {

using meshcontour::Image;

namespace {

bool differ(const std::uint8_t* a, const std::uint8_t* b, int levels) {
  for (int c = 0; c < 4; ++c) {
    if (std::abs(a[c] - b[c]) > levels) return true;
  }
  return false;
}

}  // namespace

double differing_share(const Image& a, const Image& b, int levels) {
  if (a.width != b.width || a.height != b.height || a.rgba.size() != b.rgba.size()) return 1;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) count += differ(&a.rgba[i], &b.rgba[i], levels);
  return a.rgba.empty() ? 0 : 4.0 * static_cast<double>(count) / static_cast<double>(a.rgba.size());
}

Image decode_png(std::span<const std::uint8_t> bytes) {
  Image image;
  int channels = 0;
  stbi_uc* pixels = stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &image.width,
                                          &image.height, &channels, 4);
  if (pixels == nullptr) throw std::runtime_error(std::string("not a PNG: ") + stbi_failure_reason());
  image.rgba.assign(pixels, pixels + 4 * static_cast<std::ptrdiff_t>(image.width) * image.height);
  stbi_image_free(pixels);
  return image;
}

Image read_png(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (bytes.empty()) throw std::runtime_error(file.string() + " is not there");
  return decode_png(bytes);
}

Image side_by_side(const Image& a, const Image& b, int levels) {
  Image out{3 * a.width, a.height, {}};
  out.rgba.assign(3 * a.rgba.size(), 255);
  if (a.rgba.size() != b.rgba.size()) return out;
  const auto row = 4 * static_cast<std::size_t>(a.width);
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    std::uint8_t* pixel = &out.rgba[i / row * 3 * row + i % row];
    const std::uint8_t difference = differ(&a.rgba[i], &b.rgba[i], levels) ? 255 : 0;
    for (std::size_t c = 0; c < 4; ++c) {
      pixel[c] = a.rgba[i + c];
      pixel[row + c] = b.rgba[i + c];
      pixel[2 * row + c] = c < 3 ? difference : 255;
    }
  }
  return out;
}

}  // namespace pictures

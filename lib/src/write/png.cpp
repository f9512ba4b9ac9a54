// The only file that knows stb_image_write; libdeflate stands behind its hook for compression.

#include "write/png.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <memory>

namespace {

// As stb calls it: the result is freed with free(), null is failure.
unsigned char* zlib_compress(const unsigned char* data, int size, int* compressed_size, int level) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (compressor == nullptr) return nullptr;
  const std::size_t bound = libdeflate_zlib_compress_bound(compressor.get(), static_cast<std::size_t>(size));
  auto* out = static_cast<unsigned char*>(std::malloc(bound));
  if (out == nullptr) return nullptr;
  const std::size_t length =
      libdeflate_zlib_compress(compressor.get(), data, static_cast<std::size_t>(size), out, bound);
  if (length == 0 || length > INT_MAX) {
    std::free(out);
    return nullptr;
  }
  *compressed_size = static_cast<int>(length);
  return out;
}

}  // namespace

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#define STBIW_ZLIB_COMPRESS zlib_compress
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace meshcontour {
namespace {

constexpr int kLevel = 6;     // of libdeflate; smaller files than stb's own 8
constexpr int kUpFilter = 2;  // one filter for all rows: choosing one a row costs more than it saves here

bool opaque(const Image& image) {
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    if (image.rgba[i] != 255) return false;
  }
  return true;
}

std::vector<std::uint8_t> without_alpha(const Image& image) {
  const std::size_t pixels = image.rgba.size() / 4;
  std::vector<std::uint8_t> rgb(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) rgb[3 * i + c] = image.rgba[4 * i + c];
  }
  return rgb;
}

void check(const Image& image) {
  const auto width = static_cast<std::size_t>(std::max(image.width, 0));
  const auto height = static_cast<std::size_t>(std::max(image.height, 0));
  if (width == 0 || height == 0 || image.rgba.size() != 4 * width * height) {
    throw Error(ErrorCode::Internal, "an image whose size and pixels do not match");
  }
  // stb counts the bytes of the filtered rows in an int.
  if ((4 * width + 1) * height > INT_MAX) {
    throw Error(ErrorCode::OutOfMemory,
                fmt::format("a PNG of {} x {} pixels is beyond 2 GiB", width, height));
  }
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image) {
  check(image);
  static const bool configured = [] {
    stbi_write_force_png_filter = kUpFilter;
    stbi_write_png_compression_level = kLevel;
    return true;
  }();
  (void)configured;
  const bool drop_alpha = opaque(image);
  const std::vector<std::uint8_t> rgb = drop_alpha ? without_alpha(image) : std::vector<std::uint8_t>();
  const int channels = drop_alpha ? 3 : 4;
  int size = 0;
  const std::unique_ptr<unsigned char, decltype(&std::free)> png(
      stbi_write_png_to_mem(drop_alpha ? rgb.data() : image.rgba.data(), channels * image.width, image.width,
                            image.height, channels, &size),
      &std::free);
  if (png == nullptr) throw Error(ErrorCode::OutOfMemory, "not enough memory to encode the picture");
  return {png.get(), png.get() + size};
}

}  // namespace meshcontour

// The only file that knows stb_image_write; libdeflate stands behind its hook for compression.

#include "write/png.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <cstring>
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

// Chosen for pictures of models, with their even faces and background: smaller files than stb's own in a
// fifth of the time. Other filters make most of them larger.
constexpr int kLevel = 4;   // of libdeflate
constexpr int kFilter = 0;  // of PNG: none

Error out_of_memory() {
  return {ErrorCode::OutOfMemory, "not enough memory to encode the picture"};
}

bool opaque(const Image& image) {
  std::uint8_t all = 255;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) all &= image.rgba[i];
  return all == 255;
}

// Freed by hand, not zeroed before use: the pictures are large.
using Bytes = std::unique_ptr<unsigned char, decltype(&std::free)>;

Bytes without_alpha(const Image& image) {
  const std::size_t pixels = image.rgba.size() / 4;
  Bytes rgb(static_cast<unsigned char*>(std::malloc(3 * pixels + 1)), &std::free);
  if (rgb == nullptr) throw out_of_memory();
  const std::uint8_t* in = image.rgba.data();
  unsigned char* out = rgb.get();
  // Four bytes at a time; the fourth is the next pixel's first, which comes after.
  for (std::size_t i = 0; i < pixels; ++i, in += 4, out += 3) std::memcpy(out, in, 4);
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
    stbi_write_force_png_filter = kFilter;
    stbi_write_png_compression_level = kLevel;
    return true;
  }();
  (void)configured;
  const bool drop_alpha = opaque(image);
  const Bytes rgb = drop_alpha ? without_alpha(image) : Bytes(nullptr, &std::free);
  const unsigned char* pixels = drop_alpha ? rgb.get() : image.rgba.data();
  const int channels = drop_alpha ? 3 : 4;
  int size = 0;
  const Bytes png(
      stbi_write_png_to_mem(pixels, channels * image.width, image.width, image.height, channels, &size),
      &std::free);
  if (png == nullptr) throw out_of_memory();
  return {png.get(), png.get() + size};
}

}  // namespace meshcontour

#include "render/gl_readback.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "render/gl_framebuffer.hpp"

namespace meshcontour::detail {
namespace {

using Sample = std::uint32_t;  // four channels, in the order of their bytes

constexpr Sample kEven = 0x00ff00ff;  // two channels, each with room for a sum

// Rows of samples to one row of pixels. Colours are times alpha until here.
template <unsigned kAcross>
void average_row(const Sample* samples, std::size_t pixels, std::uint8_t* out) {
  constexpr unsigned kShift = kAcross == 1 ? 0 : kAcross == 2 ? 2 : 4;
  constexpr Sample kHalf = (1U << kShift) / 2 * 0x00010001U;
  for (std::size_t i = 0; i < pixels; ++i) {
    Sample even = kHalf, odd = kHalf;
    for (std::size_t row = 0; row < kAcross; ++row) {
      for (std::size_t column = 0; column < kAcross; ++column) {
        const Sample sample = samples[kAcross * (row * pixels + i) + column];
        even += sample & kEven;
        odd += sample >> 8 & kEven;
      }
    }
    const Sample mean = (even >> kShift & kEven) | (odd >> kShift & kEven) << 8;
    std::memcpy(out + 4 * i, &mean, sizeof mean);
  }
}

void average_row(int across, const Sample* samples, std::size_t pixels, std::uint8_t* out) {
  switch (across) {
    case 1:
      return average_row<1>(samples, pixels, out);
    case 2:
      return average_row<2>(samples, pixels, out);
    default:
      return average_row<4>(samples, pixels, out);
  }
}

void divide_by_alpha(std::uint8_t* row, std::size_t pixels) {
  for (std::size_t i = 0; i < pixels; ++i, row += 4) {
    const unsigned alpha = row[3];
    if (alpha == 0 || alpha == 255) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      row[c] = static_cast<std::uint8_t>(std::min(255U, (row[c] * 255U + alpha / 2) / alpha));
    }
  }
}

Sample sample_of(const std::array<std::uint8_t, 4>& color) {
  Sample sample = 0;
  std::memcpy(&sample, color.data(), sizeof sample);
  return sample;
}

bool all_equal(const Sample* samples, std::size_t count, Sample value) {
  constexpr std::size_t kStep = 512;  // without a branch
  for (std::size_t begin = 0; begin < count; begin += kStep) {
    Sample difference = 0;
    for (std::size_t i = begin; i < std::min(count, begin + kStep); ++i) difference |= samples[i] ^ value;
    if (difference != 0) return false;
  }
  return true;
}

}  // namespace

void fill_background(Image& image, const std::array<std::uint8_t, 4>& background) {
  std::array<std::uint8_t, 4> pixel = background;
  divide_by_alpha(pixel.data(), 1);
  const Sample value = sample_of(pixel);
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  image.rgba.assign(4 * pixels, pixel[0]);
  if (value == pixel[0] * 0x01010101U) return;
  for (std::size_t i = 0; i < pixels; ++i) std::memcpy(image.rgba.data() + 4 * i, &value, sizeof value);
}

bool average_into(Image& image, const Readback& part) {
  const int columns = std::min(part.width, image.width - part.left);
  const int rows = std::min(part.height, image.height - part.bottom);
  constexpr int kBand = 16;  // rows of samples at a time: they stay in the cache
  const auto pixels = static_cast<std::size_t>(columns), across = static_cast<std::size_t>(part.across);
  const std::size_t row_samples = pixels * across * across;
  const int band = kBand / part.across;
  std::vector<Sample> samples(row_samples * static_cast<std::size_t>(band));
  const Sample background = sample_of(part.background);
  bool something = false;
  for (int first = 0; first < rows; first += band) {
    const int count = std::min(band, rows - first);
    glReadPixels(part.margin, part.margin + part.across * first, part.across * columns, part.across * count,
                 GL_RGBA, GL_UNSIGNED_BYTE, samples.data());
    for (int row = 0; row < count; ++row) {
      const Sample* begin = samples.data() + static_cast<std::size_t>(row) * row_samples;
      if (all_equal(begin, row_samples, background)) continue;
      something = true;
      const int from_top = image.height - 1 - (part.bottom + first + row);
      std::uint8_t* out = image.rgba.data() +
                          4 * (static_cast<std::size_t>(from_top) * static_cast<std::size_t>(image.width) +
                               static_cast<std::size_t>(part.left));
      average_row(part.across, begin, pixels, out);
      if (part.background[3] != 255) divide_by_alpha(out, pixels);
    }
  }
  check_gl("reading the picture back");
  return something;
}

}  // namespace meshcontour::detail

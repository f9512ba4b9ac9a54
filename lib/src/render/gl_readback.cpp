#include "render/gl_readback.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "render/gl_framebuffer.hpp"

namespace meshcontour::detail {
namespace {

// Rows of samples to one row of pixels. Colours are times alpha until here.
template <std::size_t kAcross>
void average_row(const std::uint8_t* samples, std::size_t pixels, std::uint8_t* out) {
  constexpr unsigned kSamples = kAcross * kAcross;
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      unsigned sum = kSamples / 2;
      for (std::size_t row = 0; row < kAcross; ++row) {
        const std::uint8_t* sample = samples + 4 * kAcross * (row * pixels + i) + c;
        for (std::size_t column = 0; column < kAcross; ++column) sum += sample[4 * column];
      }
      out[4 * i + c] = static_cast<std::uint8_t>(sum / kSamples);
    }
  }
}

void average_row(int across, const std::uint8_t* samples, std::size_t pixels, std::uint8_t* out) {
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

// Samples may round by a level.
bool differs(const std::vector<std::uint8_t>& samples, std::size_t size,
             const std::array<double, 4>& background) {
  std::array<int, 4> level{};
  for (std::size_t c = 0; c < 4; ++c) level[c] = static_cast<int>(std::lround(255 * background[c]));
  for (std::size_t i = 0; i < size; ++i) {
    if (std::abs(samples[i] - level[i % 4]) > 1) return true;
  }
  return false;
}

}  // namespace

bool average_into(Image& image, const Readback& part) {
  const int columns = std::min(part.width, image.width - part.left);
  const int rows = std::min(part.height, image.height - part.bottom);
  constexpr int kBand = 32;  // rows of samples at a time: they stay in the cache
  const auto pixels = static_cast<std::size_t>(columns), across = static_cast<std::size_t>(part.across);
  const std::size_t pixel_row = 4 * pixels * across * across;  // samples' bytes
  const int band = kBand / part.across;
  std::vector<std::uint8_t> samples(pixel_row * static_cast<std::size_t>(band));
  bool something = false;
  for (int first = 0; first < rows; first += band) {
    const int count = std::min(band, rows - first);
    glReadPixels(part.margin, part.margin + part.across * first, part.across * columns, part.across * count,
                 GL_RGBA, GL_UNSIGNED_BYTE, samples.data());
    something = something || differs(samples, static_cast<std::size_t>(count) * pixel_row, part.background);
    for (int row = 0; row < count; ++row) {
      const int from_top = image.height - 1 - (part.bottom + first + row);
      std::uint8_t* out = image.rgba.data() +
                          4 * (static_cast<std::size_t>(from_top) * static_cast<std::size_t>(image.width) +
                               static_cast<std::size_t>(part.left));
      average_row(part.across, samples.data() + static_cast<std::size_t>(row) * pixel_row, pixels, out);
      divide_by_alpha(out, pixels);
    }
  }
  check_gl("reading the picture back");
  return something;
}

}  // namespace meshcontour::detail

#include "render/gl_readback.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "render/gl_framebuffer.hpp"

namespace meshcontour::detail {
namespace {

// Two rows of samples to one row of pixels. Colours are times alpha until here.
void average_row(const std::uint8_t* lower, const std::uint8_t* upper, std::size_t pixels,
                 std::uint8_t* out) {
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      const std::size_t a = 8 * i + c, b = a + 4;
      out[4 * i + c] = static_cast<std::uint8_t>((lower[a] + lower[b] + upper[a] + upper[b] + 2) / 4);
    }
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
  constexpr int kBand = 16;  // pixel rows at a time: the samples stay in the cache
  const auto pixels = static_cast<std::size_t>(columns);
  const std::size_t sample_row = 8 * pixels;
  std::vector<std::uint8_t> samples(sample_row * 2 * kBand);
  bool something = false;
  for (int first = 0; first < rows; first += kBand) {
    const int count = std::min(kBand, rows - first);
    glReadPixels(part.margin, part.margin + 2 * first, 2 * columns, 2 * count, GL_RGBA, GL_UNSIGNED_BYTE,
                 samples.data());
    something =
        something || differs(samples, 2 * static_cast<std::size_t>(count) * sample_row, part.background);
    for (int row = 0; row < count; ++row) {
      const int from_top = image.height - 1 - (part.bottom + first + row);
      std::uint8_t* out = image.rgba.data() +
                          4 * (static_cast<std::size_t>(from_top) * static_cast<std::size_t>(image.width) +
                               static_cast<std::size_t>(part.left));
      const std::uint8_t* lower = samples.data() + 2 * static_cast<std::size_t>(row) * sample_row;
      average_row(lower, lower + sample_row, pixels, out);
      divide_by_alpha(out, pixels);
    }
  }
  check_gl("reading the picture back");
  return something;
}

}  // namespace meshcontour::detail

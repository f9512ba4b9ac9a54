// Pictures of a model as PNG, beside stb_image_write with its own compression: processor milliseconds, in
// turn, and bytes.
//
// usage: bench_png_encoding MODEL [rounds]

#include <fmt/format.h>

#include <cstdlib>

#include "bench/bench.hpp"
#include "bench/stb_writer.hpp"
#include "meshcontour/fit.hpp"
#include "meshcontour/read.hpp"
#include "meshcontour/render.hpp"
#include "write/png.hpp"

using namespace meshcontour;

namespace {

std::vector<std::uint8_t> without_alpha(const Image& image) {
  std::vector<std::uint8_t> rgb;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    rgb.insert(rgb.end(), &image.rgba[i], &image.rgba[i + 3]);
  return rgb;
}

void measure(const Image& image, const char* layers, int rounds) {
  const std::vector<std::uint8_t> rgb = without_alpha(image);
  std::size_t ours = 0;
  int theirs = 0;
  std::vector<bench::Contender> contenders = {
      {"", [&] { ours = encode_png(image).size(); }},
      {"", [&] {
         std::free(stbi_write_png_to_mem(rgb.data(), 3 * image.width, image.width, image.height, 3, &theirs));
       }}};
  bench::alternate(contenders, rounds);
  const double own = contenders[0].median(), stb = contenders[1].median();
  fmt::print("| {} | {}x{} | {:.1f} | {:.1f} | {:.2f} | {} | {} |\n", layers, image.width, image.height,
             1000 * own, 1000 * stb, own / stb, ours, theirs);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 64;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
  std::vector<Diagnostic> diagnostics;
  const Model model = read_model(std::filesystem::path(argv[1]));
  const auto boundaries = extract_boundaries(model, {}, diagnostics);
  const auto contours = fit_contours(model, boundaries, {}, diagnostics);
  fmt::print(
      "| layers | size | ours, ms | stb, ms | ours / stb | bytes | of stb "
      "|\n|---|---|---:|---:|---:|---:|---:|\n");
  RenderOptions options;
  for (const auto& [width, height] : {std::pair(500, 500), std::pair(1920, 1080)}) {
    options.width = width;
    options.height = height;
    options.layers = {Layer::Mesh, Layer::Edges, Layer::Curves};
    measure(render(model, boundaries, contours, options), "mesh,edges,curves", rounds);
    options.layers = {Layer::Mesh};
    measure(render(model, boundaries, contours, options), "mesh", rounds);
    options.layers = {Layer::Edges, Layer::Curves};
    measure(render(model, boundaries, contours, options), "edges,curves", rounds);
  }
  return 0;
}

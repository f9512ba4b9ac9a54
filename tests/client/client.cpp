// Reads a model and prints how many loops of how many kinds of curves it has; draws it when a second file is
// named.

#include <cstdio>
#include <map>
#include <meshcontour/pipeline.hpp>
#include <meshcontour/version.hpp>

int main(int argc, char** argv) {
  if (argc < 2) return 64;
  meshcontour::Job job;
  job.input = argv[1];
  if (argc > 2) job.outputs.push_back({argv[2], meshcontour::OutputFormat::Png});
  try {
    const meshcontour::Run run = meshcontour::run(job);
    std::map<std::size_t, int> kinds;
    for (const auto& contour : run.contours) {
      for (const auto& segment : contour.segments) ++kinds[segment.curve.index()];
    }
    std::printf("meshcontour %s: %zu contours, %zu kinds of curves\n", meshcontour::version().data(),
                run.contours.size(), kinds.size());
  } catch (const meshcontour::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
}

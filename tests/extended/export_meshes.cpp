// Writes one model as a mesh in every format and variant, for other programs to read: export_meshes FOLDER
// FILE

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "meshcontour/mesh_write.hpp"
#include "meshcontour/read.hpp"

namespace {

using namespace meshcontour;

void write(const Model& model, const std::filesystem::path& target, const MeshWriteOptions& options) {
  StringSink sink;
  std::vector<Diagnostic> notes;
  write_mesh(*mesh_format(target.extension().string()), model, options, sink, notes);
  std::ofstream(target, std::ios::binary) << sink.text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: export_meshes FOLDER FILE\n");
    return 64;
  }
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    const Model model = read_model(std::filesystem::path(argv[2]));
    for (const bool patches : {false, true}) {
      const std::string name = patches ? "patches" : "plain";
      write(model, folder / (name + ".off"), {.patches = patches});
      write(model, folder / (name + ".obj"), {.patches = patches});
      for (const bool binary : {false, true}) {
        const std::string kind = name + (binary ? "-binary" : "-text");
        write(model, folder / (kind + ".stl"), {.binary = binary, .patches = patches});
        write(model, folder / (kind + ".ply"), {.binary = binary, .patches = patches});
      }
    }
    fmt::print("{} {}\n", model.shells[0].points.size(), model.shells[0].triangles.size());
  } catch (const std::exception& error) {
    fmt::print(stderr, "export_meshes: {}\n", error.what());
    return 70;
  }
}

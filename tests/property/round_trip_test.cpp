// Mesh files give back what was written: triangles, loops and curves, bit for bit.

#include "meshcontour/fit.hpp"
#include "meshcontour/mesh_write.hpp"
#include "meshcontour/read.hpp"
#include "meshcontour/segmentation.hpp"
#include "meshcontour/write.hpp"
#include "support/catch.hpp"
#include "support/paths.hpp"

using namespace meshcontour;

namespace {

struct File {
  std::string name;
  MeshFormat format;
  bool binary;
};

const std::vector<File> kFiles = {{"a.off", MeshFormat::Off, false},    {"a.obj", MeshFormat::Obj, false},
                                  {"text.ply", MeshFormat::Ply, false}, {"binary.ply", MeshFormat::Ply, true},
                                  {"text.stl", MeshFormat::Stl, false}, {"binary.stl", MeshFormat::Stl, true},
                                  {"a.net", MeshFormat::Net, false}};

Model through(const File& file, const Model& model) {
  StringSink sink;
  std::vector<Diagnostic> notes;
  write_mesh(file.format, model, {.binary = file.binary}, sink, notes);
  CHECK(notes.empty());
  return read_model(sink.text, file.name);
}

Model stud() {
  Model model = read_model(std::filesystem::path(MESHCONTOUR_DATA_DIR) / "stud.xml");
  model.shells[0].id = "mesh";  // the only name that these files have
  return model;
}

// Loops and curves as tables, with all digits.
std::string tables(const Model& model) {
  std::vector<Diagnostic> notes;
  const auto boundaries = extract_boundaries(model, {}, notes);
  const auto contours = fit_contours(model, boundaries, {}, notes);
  const Result result{model, boundaries, contours};
  StringSink sink;
  for (const CsvContent content : {CsvContent::Loops, CsvContent::Curves}) {
    write_output(OutputFormat::Csv, result, {.csv = content}, sink, notes);
  }
  CHECK(sink.text.size() > 1000);
  return sink.text;
}

void check_same(const Model& model, const Model& other) {
  CHECK(model.shells[0].points == other.shells[0].points);
  CHECK(model.shells[0].triangles == other.shells[0].triangles);
  CHECK(tables(model) == tables(other));
}

// Patches by angle, whatever the file knows.
Model segmented(Model model) {
  segment_model(model, {.source = PatchSource::Angle});
  return model;
}

}  // namespace

TEST_CASE("round trip: formats with patches give back triangles, loops and curves of a CAD model",
          "[property]") {
  const Model model = stud();
  for (const File& file : kFiles) {
    if (file.format == MeshFormat::Stl || file.format == MeshFormat::Net) continue;
    INFO(file.name);
    check_same(through(file, model), model);
  }
}

TEST_CASE("round trip: text STL gives back the coordinates of a CAD model, and all patches", "[property]") {
  const Model model = stud(), back = through(kFiles[4], model);
  REQUIRE(back.shells[0].triangles.size() == model.shells[0].triangles.size());
  for (std::size_t t = 0; t < model.shells[0].triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(back.shells[0].points[back.shells[0].triangles[t][k]] ==
            model.shells[0].points[model.shells[0].triangles[t][k]]);
    }
  }
  CHECK(back.shells[0].patches.size() == model.shells[0].patches.size());
}

TEST_CASE("round trip: what was an STL stays the same through every format", "[property]") {
  const bool binary = GENERATE(false, true);
  // Twice, as STL numbers points by their first appearance in the order of the patches.
  const File stl{"a.stl", MeshFormat::Stl, binary};
  const Model model = segmented(through(stl, segmented(through(stl, stud()))));
  const std::size_t patches = model.shells[0].patches.size();
  CHECK(patches > 5);
  for (const File& file : kFiles) {
    if (file.name == "binary.stl" && !binary) continue;  // holds single precision only
    INFO(file.name);
    Model back = through(file, model);
    CHECK(back.shells[0].patches.size() == (file.name == "binary.stl" || file.name == "a.net" ? 1 : patches));
    check_same(segmented(back), model);
  }
}

// Writes one model in every format and variant, for other programs to read:
//   export_all FOLDER          FOLDER/curves, a model with every kind of curve, placed three times, and
//                              FOLDER/shapes, the contours of shapes known exactly, a shell each
//   export_all FOLDER FILE...  each file's contours, into a folder of its own name

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "meshcontour/fit.hpp"
#include "meshcontour/read.hpp"
#include "support/shapes.hpp"
#include "unit/write/sample.hpp"

namespace {

using namespace meshcontour;

Sample placed_sample() {
  Sample s = sample();
  s.model.name = "every kind of curve: \xc3\xa9 'x' \\ <&>";
  s.model.instances.push_back({0, placement({100, -20, 5}, 0.7, {0, 0, 1}), "root/turned"});
  s.model.instances.push_back({0, placement({0, 80, -10}, 1.1, {1, 2, 3}, -2), "root/mirrored"});
  s.model.annotations = {{"note", {{0, 0, -5}, {10, 0, -5}, {10, 10, -6}}}};
  s.model.curves = {named("rail", rational_spline()), named("axis", LineSegment{{0, 0, -30}, {0, 0, 30}})};
  return s;
}

Sample fitted(Model model) {
  Sample s;
  std::vector<Diagnostic> diagnostics;
  s.model = std::move(model);
  s.boundaries = extract_boundaries(s.model, {}, diagnostics);
  FitOptions fit;
  fit.method = FitMethod::Primitives;
  s.contours = fit_contours(s.model, s.boundaries, fit, diagnostics);
  return s;
}

Sample shapes_sample() {
  Model model;
  for (const shapes::Shape& shape : shapes::all()) {
    const double sagitta = 1e-4 * shapes::size(shape);
    Model one = shapes::model_of(shapes::tessellate(shape, sagitta, shapes::Steps::Adaptive).points);
    one.shells[0].id = shape.name;
    model.instances.push_back({model.shells.size(), Eigen::Affine3d::Identity(), shape.name});
    model.shells.push_back(std::move(one.shells[0]));
  }
  return fitted(std::move(model));
}

void write_all(const Sample& s, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const auto write = [&](const std::string& name, OutputFormat format, const WriteOptions& options) {
    std::ofstream(folder / name, std::ios::binary) << written(format, s, options);
  };
  WriteOptions plain, other;
  plain.view = other.view = View::Top;
  other.step = StepSchema::Ap214;
  other.dxf = DxfContent::Polyline;
  other.obj = ObjContent::Curves;
  write("model.json", OutputFormat::Json, plain);
  write("loops.csv", OutputFormat::Csv, plain);
  write("model.svg", OutputFormat::Svg, plain);
  write("ap242.step", OutputFormat::Step, plain);
  write("ap214.step", OutputFormat::Step, other);
  write("curves.dxf", OutputFormat::Dxf, plain);
  write("polyline.dxf", OutputFormat::Dxf, other);
  write("polylines.obj", OutputFormat::Obj, plain);
  write("model.glb", OutputFormat::Glb, plain);
  write("curves.obj", OutputFormat::Obj, other);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: export_all FOLDER [FILE...]\n");
    return 64;
  }
  try {
    const std::filesystem::path folder = argv[1];
    if (argc == 2) {
      write_all(placed_sample(), folder / "curves");
      write_all(shapes_sample(), folder / "shapes");
    }
    for (int i = 2; i < argc; ++i) {
      const std::filesystem::path file = argv[i];
      write_all(fitted(read_model(file)), folder / file.stem());
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "export_all: {}\n", error.what());
    return 70;
  }
}

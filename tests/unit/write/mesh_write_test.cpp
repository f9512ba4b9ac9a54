#include "meshcontour/mesh_write.hpp"

#include "meshcontour/boundary.hpp"
#include "meshcontour/read.hpp"
#include "meshcontour/segmentation.hpp"
#include "support/catch.hpp"
#include "support/dirty_meshes.hpp"

using namespace meshcontour;

namespace {

// A torus and a cube of six coloured patches, with one point that nothing uses.
Model sample() {
  Model model;
  Shell cube = dirty::with_isolated_points(dirty::cube(), 1);
  for (Point& p : cube.points) p = Point(p.x() / 3, p.y() * 1e-7, p.z() + 0.1);
  segment_by_feature_angle(cube, 0.5);
  for (std::size_t p = 0; p < cube.patches.size(); ++p) {
    cube.patches[p].color = {static_cast<std::uint8_t>(40 * p), 7, 255, 255};
  }
  model.shells = {cube};
  model.instances = {{0, Eigen::Affine3d::Identity(), ""}};
  return model;
}

std::string written(MeshFormat format, const Model& model, const MeshWriteOptions& options = {}) {
  StringSink sink;
  std::vector<Diagnostic> notes;
  write_mesh(format, model, options, sink, notes);
  CHECK(notes.empty());
  return sink.text;
}

std::string_view name_of(MeshFormat format) {
  constexpr std::array<std::string_view, 4> kNames = {"a.off", "a.obj", "a.stl", "a.ply"};
  return kNames[static_cast<std::size_t>(format)];
}

std::vector<std::size_t> loop_sizes(const Model& model) {
  std::vector<Diagnostic> diagnostics;
  std::vector<std::size_t> sizes;
  for (const ShellBoundary& shell : extract_boundaries(model, {}, diagnostics)) {
    for (const PatchBoundary& patch : shell.patches) {
      for (const BoundaryLoop& loop : patch.loops) sizes.push_back(loop.vertices.size());
    }
  }
  return sizes;
}

}  // namespace

TEST_CASE("mesh_format: by name or extension", "[write][mesh]") {
  CHECK(mesh_format(".PLY") == MeshFormat::Ply);
  CHECK(mesh_format("stl") == MeshFormat::Stl);
  CHECK_FALSE(mesh_format("png"));
}

TEST_CASE("write_mesh: what is written reads back the same, points, triangles and patches", "[write][mesh]") {
  const Model model = sample();
  const Shell& shell = model.shells[0];
  for (const MeshFormat format : {MeshFormat::Off, MeshFormat::Obj, MeshFormat::Ply}) {
    for (const bool binary : {false, true}) {
      INFO(name_of(format) << " " << binary);
      const std::string bytes = written(format, model, {binary, true});
      const Model back = read_model(bytes, name_of(format));
      CHECK(back.shells[0].points == shell.points);
      CHECK(back.shells[0].triangles == shell.triangles);
      REQUIRE(back.shells[0].patches.size() == 6);
      for (std::size_t p = 0; p < 6; ++p) {
        CHECK(back.shells[0].patches[p].first_triangle == shell.patches[p].first_triangle);
        if (format != MeshFormat::Obj) CHECK(back.shells[0].patches[p].color == shell.patches[p].color);
      }
      CHECK(loop_sizes(back) == loop_sizes(model));
      if (format != MeshFormat::Obj) CHECK(written(format, back, {binary, true}) == bytes);
    }
  }
}

TEST_CASE("write_mesh: STL keeps the triangles, text the patches too", "[write][mesh]") {
  const Model model = sample();
  for (const bool binary : {false, true}) {
    const std::string bytes = written(MeshFormat::Stl, model, {binary, true});
    const Model back = read_model(bytes, "a.stl");
    const Shell &shell = model.shells[0], &again = back.shells[0];
    CHECK(again.points.size() == 8);
    REQUIRE(again.triangles.size() == shell.triangles.size());
    for (std::size_t t = 0; t < shell.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Point& was = shell.points[shell.triangles[t][k]];
        const Point& is = again.points[again.triangles[t][k]];
        CHECK((binary ? is.cast<float>() == was.cast<float>() : is == was));
      }
    }
    CHECK(back.has_patches == !binary);
    CHECK(again.patches.size() == (binary ? 1 : 6));
    CHECK(written(MeshFormat::Stl, back, {binary, true}) == bytes);
  }
}

TEST_CASE("write_mesh: every instance is written where it stands, mirrored ones turned", "[write][mesh]") {
  Model model = sample();
  Eigen::Affine3d mirror = Eigen::Affine3d::Identity();
  mirror.linear()(0, 0) = -1;
  mirror.translation() = Vector(-1, 0, 0);
  model.instances.push_back({0, mirror, ""});
  for (const MeshFormat format : {MeshFormat::Off, MeshFormat::Obj, MeshFormat::Ply, MeshFormat::Stl}) {
    const Shell back = read_model(written(format, model), name_of(format)).shells[0];
    CHECK(back.triangles.size() == 24);
    double volume = 0;
    for (const Triangle& t : back.triangles) {
      volume += back.points[t[0]].dot(back.points[t[1]].cross(back.points[t[2]])) / 6;
    }
    CHECK(volume == Approx(2 * 1e-7 / 3));
    if (format != MeshFormat::Stl) CHECK(back.points[9].x() == -1);
    if (format == MeshFormat::Obj || format == MeshFormat::Ply) CHECK(back.patches.size() == 12);
  }
}

TEST_CASE("write_mesh: patches of one colour are told apart, or left out on request", "[write][mesh]") {
  Model model = sample();
  for (Patch& patch : model.shells[0].patches) patch.color = Rgba{};
  for (const MeshFormat format : {MeshFormat::Off, MeshFormat::Obj, MeshFormat::Ply}) {
    CHECK(read_model(written(format, model), name_of(format)).shells[0].patches.size() == 6);
    for (const bool binary : {false, true}) {
      const Model plain = read_model(written(format, model, {binary, false}), name_of(format));
      CHECK_FALSE(plain.has_patches);
      CHECK(plain.shells[0].triangles == model.shells[0].triangles);
    }
  }
  CHECK_FALSE(read_model(written(MeshFormat::Stl, model, {false, false}), "a.stl").has_patches);
}

TEST_CASE("write_mesh: single precision says what it cannot hold", "[write][mesh][error]") {
  Model model = sample();
  StringSink sink;
  std::vector<Diagnostic> notes;
  model.shells[0].points[1] = model.shells[0].points[0] + Vector(0, 0, 1e-12);
  write_mesh(MeshFormat::Stl, model, {}, sink, notes);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].count == 2);
  model.shells[0].points[1].x() = 1e40;
  CHECK_THROWS_WITH(write_mesh(MeshFormat::Stl, model, {}, sink, notes),
                    "a coordinate is too large for binary STL");
}

TEST_CASE("write_mesh: no shell, or one without triangles, gives a file that reads", "[write][mesh]") {
  Model model;
  for (const MeshFormat format : {MeshFormat::Off, MeshFormat::Stl, MeshFormat::Ply}) {
    CHECK(read_model(written(format, model), name_of(format)).shells[0].triangles.empty());
  }
}

TEST_CASE("write_lines: OBJ polylines and a VRML line set", "[write][mesh]") {
  const std::vector<Polyline> lines = {{"tree", {{0, 0, 0}, {1, 0, 0}, {1, 0.1, 0}}},
                                       {"tree", {{2, 0, 0}, {3, 0, 0}}}};
  StringSink obj, wrl;
  write_lines(LineFormat::Obj, lines, obj);
  CHECK(obj.text == "o tree\nv 0 0 0\nv 1 0 0\nv 1 0.1 0\nl 1 2 3\nv 2 0 0\nv 3 0 0\nl 4 5\n");
  write_lines(LineFormat::Wrl, lines, wrl);
  CHECK(wrl.text.starts_with("#VRML V2.0 utf8\n"));
  CHECK(wrl.text.find("0, 1, 2, -1,\n3, 4, -1,\n") != std::string::npos);
}

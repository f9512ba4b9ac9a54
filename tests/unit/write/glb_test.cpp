#include <cstring>
#include <nlohmann/json.hpp>

#include "meshcontour/fit.hpp"
#include "meshcontour/segmentation.hpp"
#include "support/catch.hpp"
#include "support/dirty_meshes.hpp"
#include "unit/write/sample.hpp"
#include "write/glb_file.hpp"

using namespace meshcontour;
using Json = nlohmann::json;

namespace {

constexpr double kMetres = 0.0254;

// A reader by the letter of the specification that believes nothing of what the file says about itself.
struct Glb {
  Json json;
  std::string binary;

  explicit Glb(const std::string& file) {
    REQUIRE(file.substr(0, 4) == "glTF");
    REQUIRE(word(file, 4) == 2);
    REQUIRE(word(file, 8) == file.size());
    const std::size_t length = word(file, 12);
    REQUIRE(length % 4 == 0);
    REQUIRE(file.substr(16, 4) == "JSON");
    json = Json::parse(file.substr(20, length));
    if (!json.contains("buffers")) {
      REQUIRE(file.size() == 20 + length);
      return;
    }
    REQUIRE(file.substr(24 + length, 4) == std::string("BIN\0", 4));
    binary = file.substr(28 + length);
    REQUIRE(word(file, 20 + length) == binary.size());
    REQUIRE(json["buffers"] == Json::array({{{"byteLength", binary.size()}}}));
  }

  static std::uint32_t word(const std::string& file, std::size_t at) {
    std::uint32_t value = 0;
    REQUIRE(at + 4 <= file.size());
    std::memcpy(&value, file.data() + at, 4);
    return value;
  }

  // The bytes of an accessor, which must lie in its view, and that in the buffer.
  std::string bytes(const Json& accessor, std::size_t each) const {
    const Json& view = json["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
    const std::size_t start = view.value("byteOffset", std::size_t{0}), size = view["byteLength"],
                      offset = accessor.value("byteOffset", std::size_t{0}), count = accessor["count"];
    REQUIRE(count > 0);
    REQUIRE((start + offset) % 4 == 0);
    REQUIRE(start + size <= binary.size());
    REQUIRE(offset + count * each <= size);
    return binary.substr(start + offset, count * each);
  }

  std::vector<Eigen::Vector3f> vectors(const Json& number) const {
    const Json& accessor = json["accessors"].at(number.get<std::size_t>());
    REQUIRE((accessor["componentType"] == 5126 && accessor["type"] == "VEC3"));
    const std::string data = bytes(accessor, 12);
    std::vector<Eigen::Vector3f> out(data.size() / 12);
    std::memcpy(static_cast<void*>(out.data()), data.data(), data.size());
    if (!accessor.contains("min")) return out;
    for (int axis = 0; axis < 3; ++axis) {
      const auto less = [&](const auto& a, const auto& b) { return a[axis] < b[axis]; };
      const auto [low, high] = std::minmax_element(out.begin(), out.end(), less);
      CHECK(accessor["min"][static_cast<std::size_t>(axis)] == static_cast<double>((*low)[axis]));
      CHECK(accessor["max"][static_cast<std::size_t>(axis)] == static_cast<double>((*high)[axis]));
    }
    return out;
  }

  std::vector<std::uint32_t> indices(const Json& number, std::size_t vertices) const {
    const Json& accessor = json["accessors"].at(number.get<std::size_t>());
    REQUIRE((accessor["componentType"] == 5125 && accessor["type"] == "SCALAR"));
    const std::string data = bytes(accessor, 4);
    std::vector<std::uint32_t> out(data.size() / 4);
    std::memcpy(out.data(), data.data(), data.size());
    for (const std::uint32_t index : out) REQUIRE(index < vertices);
    return out;
  }
};

Eigen::Matrix4d matrix_of(const Json& node) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  for (std::size_t i = 0; node.contains("matrix") && i < 16; ++i) matrix.data()[i] = node["matrix"][i];
  return matrix;
}

// Triangles and lines as they stand in the scene, in metres with y up.
struct Scene {
  struct Face {
    std::array<Point, 3> corners;
    std::array<Vector, 3> normals;
    std::size_t patch;
  };
  std::vector<Face> faces;
  std::vector<std::pair<std::string, std::array<Point, 2>>> lines;  // name of the material, ends

  explicit Scene(const Glb& glb) {
    REQUIRE(glb.json["scenes"][0]["nodes"].size() == 1);
    visit(glb, glb.json["scenes"][0]["nodes"][0], Eigen::Matrix4d::Identity());
  }

  void visit(const Glb& glb, const Json& number, const Eigen::Matrix4d& above) {
    const Json& node = glb.json["nodes"].at(number.get<std::size_t>());
    const Eigen::Affine3d place(Eigen::Matrix4d(above * matrix_of(node)));
    if (node.contains("mesh")) {
      for (const Json& primitive : glb.json["meshes"].at(node["mesh"].get<std::size_t>())["primitives"])
        add(glb, primitive, place);
    }
    if (!node.contains("children")) return;
    for (const Json& child : node["children"]) visit(glb, child, place.matrix());
  }

  void add(const Glb& glb, const Json& primitive, const Eigen::Affine3d& place) {
    const auto positions = glb.vectors(primitive["attributes"]["POSITION"]);
    const auto indices = glb.indices(primitive["indices"], positions.size());
    const auto at = [&](std::size_t i) -> Point { return place * positions[indices[i]].cast<double>(); };
    if (primitive.value("mode", 4) == 1) {
      const Json& material = glb.json["materials"].at(primitive["material"].get<std::size_t>());
      for (std::size_t i = 0; i + 1 < indices.size(); i += 2)
        lines.push_back({material["name"], {at(i), at(i + 1)}});
      return;
    }
    const auto normals = glb.vectors(primitive["attributes"]["NORMAL"]);
    REQUIRE(normals.size() == positions.size());
    const Eigen::Matrix3d turned = place.linear().inverse().transpose();
    const auto normal = [&](std::size_t i) -> Vector {
      return (turned * normals[indices[i]].cast<double>()).normalized();
    };
    // A mirrored node turns the winding, says the specification.
    const std::size_t second = place.linear().determinant() < 0 ? 2 : 1, third = 3 - second;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      faces.push_back({{at(i), at(i + second), at(i + third)},
                       {normal(i), normal(i + second), normal(i + third)},
                       primitive["extras"]["patch"]});
    }
  }
};

Point in_gltf(const Point& p) {
  return kMetres * Point(p.x(), p.z(), -p.y());
}

// A cube of six coloured patches, far from the origin of its own frame, placed four times.
Sample cubes() {
  Sample s;
  s.model.name = "cubes";
  s.model.metres_per_unit = kMetres;
  Shell cube = dirty::cube();
  segment_by_feature_angle(cube, 0.5);
  cube.id = "c</script>\"\x01\xff";
  for (Point& p : cube.points) p += Point(3e6, -7e6, 1e6);
  for (std::size_t p = 0; p < cube.patches.size(); ++p) {
    cube.patches[p].color = {static_cast<std::uint8_t>(40 * p), 7, 255, 255};
    cube.patches[p].name = "side " + std::to_string(p);
  }
  s.model.shells = {cube};
  Eigen::Affine3d sheared = Eigen::Affine3d::Identity();
  sheared(0, 1) = 0.5;
  sheared(2, 2) = -1;
  s.model.instances = {{0, Eigen::Affine3d::Identity(), "first"},
                       {0, placement({1, 2, 3}, 0.7, {1, 1, 0}), "turned"},
                       {0, placement({0, 0, 9}, 1.3, {1, 2, 3}, -2), "mirrored"},
                       {0, sheared, "sheared"}};
  std::vector<Diagnostic> diagnostics;
  s.boundaries = extract_boundaries(s.model, {}, diagnostics);
  s.contours = fit_contours(s.model, s.boundaries, {}, diagnostics);
  return s;
}

}  // namespace

TEST_CASE("glb: every instance's triangles stand where the model has them, wound and lit outwards",
          "[write][glb]") {
  const Sample s = cubes();
  const Scene scene{Glb(written(OutputFormat::Glb, s))};
  const Shell& cube = s.model.shells[0];
  REQUIRE(scene.faces.size() == 4 * cube.triangles.size());
  for (std::size_t f = 0; f < scene.faces.size(); ++f) {
    const Instance& instance = s.model.instances[f / cube.triangles.size()];
    const std::size_t t = f % cube.triangles.size();
    const auto& patch = cube.patches.at(scene.faces[f].patch - 1);
    CHECK((patch.first_triangle <= t && t < patch.first_triangle + patch.triangle_count));
    const bool mirrored = instance.placement.linear().determinant() < 0;
    const auto& corners = scene.faces[f].corners;
    const Vector facing = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    for (std::size_t c = 0; c < 3; ++c) {
      const Index vertex = cube.triangles[t][mirrored ? (3 - c) % 3 : c];
      const Point wanted = in_gltf(instance.placement * cube.points[vertex]);
      // The cube's side is 1: single precision of it, and double precision of its place.
      CHECK((corners[c] - wanted).norm() < 1e-8 * kMetres * 10);
      CHECK((scene.faces[f].normals[c] - facing).norm() < 1e-6);
    }
  }
}

TEST_CASE("glb: edges and curves are lines through the loops' vertices", "[write][glb]") {
  const Sample s = cubes();
  const Scene scene{Glb(written(OutputFormat::Glb, s))};
  std::map<std::string, std::size_t> counts;
  for (const auto& [name, ends] : scene.lines) {
    ++counts[name];
    CHECK((ends[1] - ends[0]).norm() >
          0.9 * kMetres);  // whole sides, as the mirrored instance is twice as large
    for (const Point& end : ends) {
      double nearest = 1;
      for (const Instance& instance : s.model.instances) {
        for (const Point& p : s.model.shells[0].points)
          nearest = std::min(nearest, (in_gltf(instance.placement * p) - end).norm());
      }
      CHECK(nearest < 1e-7 * kMetres);
    }
  }
  CHECK(counts == std::map<std::string, std::size_t>{{"curves", 4 * 6 * 4}, {"edges", 4 * 6 * 4}});
}

TEST_CASE("glb: shared edges are written once on request", "[write][glb]") {
  WriteOptions options;
  options.edges = EdgeUse::Unique;
  const Scene scene{Glb(written(OutputFormat::Glb, cubes(), options))};
  CHECK(scene.lines.size() == 4 * (12 + 12));
}

TEST_CASE("glb: instances share the meshes of their shell, unless a placement shears", "[write][glb]") {
  const Glb glb(written(OutputFormat::Glb, cubes()));
  std::map<std::string, std::size_t> mesh;
  for (const Json& node : glb.json["nodes"]) {
    if (node.contains("mesh") && node["name"] != "edges" && node["name"] != "curves")
      mesh[node["name"]] = node["mesh"];
  }
  REQUIRE(mesh.size() == 4);
  CHECK(mesh["first"] == mesh["turned"]);
  CHECK(mesh["first"] == mesh["mirrored"]);
  CHECK(mesh["first"] != mesh["sheared"]);
  CHECK(glb.json["meshes"].size() == 2 * 3);
}

TEST_CASE("glb: a patch has its name and its colour in linear light", "[write][glb]") {
  const Glb glb(written(OutputFormat::Glb, cubes()));
  const Json& primitives = glb.json["meshes"][0]["primitives"];
  REQUIRE(primitives.size() == 6);
  CHECK(glb.json["meshes"][0]["name"] == "shell_c</script>\"\x01\xef\xbf\xbd");
  for (std::size_t p = 0; p < 6; ++p) {
    CHECK(primitives[p]["extras"] == Json{{"patch", p + 1}, {"name", "side " + std::to_string(p)}});
    const Json& material = glb.json["materials"][primitives[p]["material"].get<std::size_t>()];
    const Json& color = material["pbrMetallicRoughness"]["baseColorFactor"];
    const double red = color[0],
                 srgb = red <= 0.0031308 ? 12.92 * red : 1.055 * std::pow(red, 1 / 2.4) - 0.055;
    CHECK(srgb * 255 == Approx(40.0 * static_cast<double>(p)).margin(0.05));
    CHECK(color[2] == 1);
  }
}

TEST_CASE("glb: the model's own curves and annotations are lines", "[write][glb]") {
  Sample s;
  s.model.annotations = {{"note", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}}, {"", {{0, 0, 0}}}};
  s.model.curves = {named("rail", rational_spline())};
  std::vector<Diagnostic> notes;
  const Scene scene{Glb(written(OutputFormat::Glb, s, {}, &notes))};
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].text().find("millimetre") != std::string::npos);
  const auto is_curve = [](const auto& line) { return line.first == "curves"; };
  CHECK(scene.lines.size() == 2 + static_cast<std::size_t>(std::ranges::count_if(scene.lines, is_curve)));
  for (const auto& [name, ends] : scene.lines) {
    if (name == "curves") CHECK(Eigen::Vector2d(ends[0].x(), ends[0].z()).norm() == Approx(3e-3));
  }
}

TEST_CASE("glb: a model without anything is a scene with one node", "[write][glb]") {
  const Glb glb(written(OutputFormat::Glb, {}));
  CHECK(glb.json["nodes"].size() == 1);
  CHECK(glb.binary.empty());
}

TEST_CASE("glb: a vertex with a fan of normals takes no quadratic time", "[write][glb]") {
  Sample s;
  Shell shell;
  constexpr Index kTriangles = 100'000;
  shell.points = {{0, 0, 1}};
  for (Index i = 0; i < kTriangles; ++i) {
    const double angle = 6.28 * i / kTriangles;
    shell.points.emplace_back(std::cos(angle), std::sin(angle), 0);
    shell.triangles.push_back({0, i + 1, (i + 1) % kTriangles + 1});
    for (int c = 0; c < 3; ++c) shell.corner_normals.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  shell.patches = {{"", {}, 0, kTriangles}};
  s.model.shells = {shell};
  s.model.instances = {{0, Eigen::Affine3d::Identity(), ""}};
  CHECK(Scene(Glb(written(OutputFormat::Glb, s))).faces.size() == kTriangles);
}

TEST_CASE("glb: what single precision or the header cannot hold is refused", "[write][glb]") {
  CHECK_NOTHROW(detail::check_glb_size(0xFFFFFFFF));
  CHECK_THROWS_WITH(detail::check_glb_size(0x100000000), Catch::Contains("4 GB"));
  Sample s = cubes();
  for (Point& p : s.model.shells[0].points) p *= 1e40;
  CHECK_THROWS_WITH(written(OutputFormat::Glb, s), Catch::Contains("too large"));
}

// The `.net` control mesh: grammar, what is refused, what is mended, and writing it back.

#include <fmt/format.h>

#include "meshcontour/cleaning.hpp"
#include "meshcontour/mesh_write.hpp"
#include "meshcontour/read.hpp"
#include "meshcontour/segmentation.hpp"
#include "meshcontour/subdivision.hpp"
#include "meshcontour/welding.hpp"
#include "support/catch.hpp"

using namespace meshcontour;

namespace {

constexpr std::string_view kCube = R"(BaseTexture stone.bmp 256 128
EnvTexture sky.bmp 64 64
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
t 0 0
t 1 0
t 1 1
t 0 1
t 0 0
t 1 0
t 1 1
t 0 1
c 1 0 0 1
c 0 1 0 1
c 0 0 1 1
c 1 1 0 1
c 0.1 0.2 0.3 0.4
c 0 1 1 1
c 1 1 1 1
c 0 0 0 0
f 0 3 2 1
f 4 5 6 7
f 0 1 5 4
f 1 2 6 5
f 2 3 7 6
f 3 0 4 7
)";

// A fan round the origin: a closed ring of k triangles, each of the points on the ring at the border.
std::string ring(int k) {
  std::string text = "v 0 0 0\n";
  for (int i = 0; i < k; ++i) text += fmt::format("v {} {} 0\n", i + 1, i * i);
  for (int i = 0; i < k; ++i) text += fmt::format("f 0 {} {}\n", i + 1, (i + 1) % k + 1);
  return text;
}

std::string with(std::string_view text, std::string_view what, std::string_view replacement) {
  std::string result(text);
  result.replace(result.find(what), what.size(), replacement);
  return result;
}

// The message of the refusal.
std::string refusal(std::string_view text, const ReadOptions& options = {}) {
  try {
    read_model(text, "a.net", options);
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::BadData);
    return error.what();
  }
  return "accepted";
}

std::string warnings(std::string_view text) {
  std::string all;
  for (const Diagnostic& diagnostic : read_model(text, "a.net").diagnostics) all += diagnostic.text() + "\n";
  return all;
}

std::string written(const Model& model, const MeshWriteOptions& options = {}) {
  StringSink sink;
  std::vector<Diagnostic> notes;
  write_mesh(MeshFormat::Net, model, options, sink, notes);
  CHECK(notes.empty());
  return sink.text;
}

}  // namespace

TEST_CASE("net: points, colours, texture coordinates, textures and fans", "[read][net]") {
  const Model model = read_model(kCube, "a.net");
  const Shell& shell = model.shells[0];
  CHECK(model.diagnostics.empty());
  CHECK(model.has_patches);
  CHECK(shell.patches.size() == 1);
  CHECK(shell.points.size() == 8);
  REQUIRE(shell.triangles.size() == 12);
  CHECK(shell.triangles[0] == Triangle{0, 3, 2});
  CHECK(shell.triangles[1] == Triangle{0, 2, 1});
  CHECK(shell.point_colors[4] == Eigen::Vector4d(0.1, 0.2, 0.3, 0.4));
  CHECK(shell.texture_coordinates[2] == Eigen::Vector2d(1, 1));
  CHECK(shell.polygons.sizes == std::vector<Index>(6, 4));
  REQUIRE(model.textures.size() == 2);
  CHECK(model.textures[0].use == "BaseTexture");
  CHECK(model.textures[1].name == "sky.bmp");
  CHECK(model.textures[0].width == 256);
  CHECK(model.textures[0].height == 128);
}

TEST_CASE("net: what is written is what was read, byte for byte", "[read][net]") {
  const Model model = read_model(kCube, "a.net");
  CHECK(written(model) == kCube);
  Model cut = model;
  segment_model(cut, {PatchSource::Angle});
  CHECK(cut.shells[0].patches.size() == 6);
  CHECK(written(cut) == kCube);
  const std::string tenth = "v 0.1 1e-300 12345678.875\nv 1 0 0\nv 0 1 0\nf 0 1 2\n";
  const std::string again = written(read_model(tenth, "a.net"));
  CHECK(read_model(again, "a.net").shells[0].points == read_model(tenth, "a.net").shells[0].points);
  CHECK(written(read_model(tenth, "a.net"), {.single_precision = true}) ==
        "v 0.1 0 12345679\nv 1 0 0\nv 0 1 0\nf 0 1 2\n");
}

TEST_CASE("net: triangles are written once the polygons have changed", "[read][net]") {
  Model model = read_model(kCube, "a.net");
  std::swap(model.shells[0].triangles[0][0], model.shells[0].triangles[0][1]);
  const std::string text = written(model);
  CHECK(text.find("f 3 0 2\nf 0 2 1\nf 4 5 6\n") != std::string::npos);
  CHECK(std::ranges::count(text, 'f') == 12);
}

TEST_CASE("net: every instance is written, mirrored ones turned, in lines of 79 bytes", "[read][net]") {
  Model model = read_model(kCube, "a.net");
  for (Eigen::Vector4d& color : model.shells[0].point_colors)
    color = Eigen::Vector4d::Constant(0.12345678901234568);
  Eigen::Affine3d mirror = Eigen::Affine3d::Identity();
  mirror.linear()(2, 2) = -1;
  mirror.translation() = Vector(1 / 3.0, -1e5 / 7, 1e-5 / 7);
  model.instances.push_back({0, mirror, ""});
  const std::string text = written(model);
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = text.find('\n', begin);
    CHECK(end - begin <= 79);
  }
  const Shell back = read_model(text, "a.net").shells[0];
  CHECK(back.point_colors ==
        std::vector(16, Eigen::Vector4d(Eigen::Vector4d::Constant(0.12345678901234568))));
  double volume = 0;
  const Point& origin = back.points[8];
  for (std::size_t t = 12; t < 24; ++t) {
    const auto [a, b, c] = back.triangles[t];
    volume += (back.points[a] - origin).dot((back.points[b] - origin).cross(back.points[c] - origin)) / 6;
  }
  CHECK(volume == Approx(8));
}

TEST_CASE("net: the ways in which the same mesh may stand in a file", "[read][net]") {
  const Shell shell = read_model(kCube, "a.net").shells[0];
  const auto same = [&](const std::string& text) {
    const Model model = read_model(text, "a.net");
    CHECK(model.shells[0].points == shell.points);
    CHECK(model.shells[0].triangles == shell.triangles);
    CHECK(model.shells[0].point_colors == shell.point_colors);
  };
  const std::string cube(kCube);
  std::string crlf, tabs, indented, faces_first;
  for (const char c : cube) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  for (const char c : cube) tabs += c == ' ' ? '\t' : c;
  for (const char c : cube) indented += c == '\n' ? "\n  " : std::string(1, c);
  const std::size_t faces = cube.find("f 0 3");
  same(crlf);
  same(tabs);
  same(indented);
  same(cube.substr(faces) + cube.substr(0, faces));
  same(cube.substr(0, cube.size() - 1));
  same("# made by hand\n\n" + cube);
  same(with(cube, "f 4 5", "#" + std::string(200, '-') + "\nf 4 5"));
  same(with(cube, "v -1 -1 -1", "v -1.00e+0   " + std::string(200, ' ') + "-1 -1"));
  const Model last = read_model(with(cube, "v -1", "BaseTexture last 1 2\nv -1"), "a.net");
  REQUIRE(last.textures.size() == 2);
  CHECK(last.textures[0].name == "last");
}

TEST_CASE("net: a file is known by its textures, by lines of no other format, or by its name",
          "[read][net]") {
  const std::string cube(kCube);
  CHECK(read_model(cube, "-").shells[0].polygons.sizes.size() == 6);
  CHECK(read_model(cube.substr(cube.find("v -1")), "-").shells[0].polygons.sizes.size() == 6);
  const std::string_view plain = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n";
  CHECK(read_model(plain, "a.NET").shells[0].triangles[0] == Triangle{1, 2, 0});
  CHECK(read_model(with(plain, "1 2 0", "1 2 3"), "-").shells[0].triangles[0] == Triangle{0, 1, 2});  // OBJ
}

TEST_CASE("net: what is wrong is named with its line", "[read][net][error]") {
  const auto cube = [](std::string_view what, std::string_view replacement) {
    return refusal(with(kCube, what, replacement));
  };
  CHECK(cube("v 1 1 -1", "v 1 1") == "a.net:5:6: expected 3 numbers, found 2");
  CHECK(cube("v 1 1 -1", "v 1 nan -1") == "a.net:5:5: expected a finite number, found 'nan'");
  CHECK(cube("v 1 1 -1", "v 1 1e999 -1") == "a.net:5:5: expected a finite number, found '1e999'");
  CHECK(cube("v 1 1 -1", "vn 1 1 -1") == "a.net:5:1: unknown keyword 'vn'");
  CHECK(cube("v 1 1 -1", "texture 1") == "a.net:5:1: unknown keyword 'texture'");
  CHECK(cube("f 4 5 6 7", "f 4/1 5 6 7") == "a.net:28:3: expected an index from 0 up, found '4/1'");
  CHECK(cube("f 4 5 6 7", "f 4 -5 6 7") == "a.net:28:5: expected an index from 0 up, found '-5'");
  CHECK(cube("f 4 5 6 7", "f 4 99999999999 6 7") ==
        "a.net:28:5: expected an index from 0 up, found '99999999999'");
  CHECK(cube("f 4 5 6 7", "f 4 5 6 8") == "a.net:28:1: index 8, but there are 8 points");
  CHECK(cube("f 4 5 6 7", "f 4 5") == "a.net:28:6: a face has 3 to 10 corners, this one has 2");
  CHECK(cube("f 4 5 6 7", "f 4 5 6 7 0 1 2 3 4 5 6") ==
        "a.net:28:23: a face has 3 to 10 corners, this one has more");
  CHECK(cube("f 4 5 6 7", "f 4 5 6 5") == "a.net:28:1: corner 5 is repeated");
  CHECK(cube("f 4 5 6 7", "f 4 5 6 7\nf 5 4 7 6") == "a.net:29:1: the same face as number 2");
  CHECK(cube("stone.bmp 256", "stone.bmp") == "a.net:1:26: expected a width and a height");
  CHECK(cube("256 128", "256 0") == "a.net:1:27: expected an integer from 1 to 4294967295, found '0'");
  CHECK(cube("256 128", "256 128 1") == "a.net:1:31: expected the end of the line, found '1'");
  CHECK(cube("stone.bmp", std::string(80, 'x')) == "a.net:1:13: the name of a texture has at most 79 bytes");
  CHECK(cube("t 0 0\n", "") == "a.net: 7 texture coordinates, but 8 points");
  CHECK(cube("c 0 0 1 1\n", "") == "a.net: 7 colours, but 8 points");
  CHECK(cube("c 0 0 1 1", "c 0 0 1") == "a.net:21:8: expected 4 numbers, found 3");
  CHECK(cube("c 0 0 1 1", "c 0 0 2 1") == "a.net:21:1: a colour has numbers from 0 to 1");
  CHECK(refusal("f 0 1 2\n") == "a.net: no point (a line 'v x y z')");
  CHECK(refusal("v 0 1 2\n") == "a.net: no face (a line 'f' with 3 to 10 indices)");
  CHECK_THROWS_WITH(read_model("", "a.net"), "a.net: empty file");
}

TEST_CASE("net: a surface that is no manifold is refused by its edge or point, and read for a repair",
          "[read][net][error]") {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nv 5 5 5\n";
  const std::string fin = points + "f 0 1 2\nf 1 0 3\nf 0 1 4\n";
  const std::string same_way = points + "f 0 1 2\nf 0 1 3\n";
  const std::string bow_tie = points + "f 0 1 2\nf 0 3 4\n";
  CHECK(refusal(fin) == "a.net:7:1: the edge 0 1 has three or more faces");
  CHECK(refusal(same_way) == "a.net:7:1: two faces run along the edge 0 1 the same way");
  CHECK(refusal(bow_tie) == "a.net:8:1: at the point 0 faces only touch (bow tie)");
  CHECK(refusal(points + "f 0 1 2\nf 0 2 1\n") == "a.net:8:1: the same face as number 1");
  ReadOptions mend;
  mend.net.mend = true;
  for (const std::string& text : {fin, same_way, bow_tie}) {
    Model model = read_model(text, "a.net", mend);
    repair_model(model);
    CHECK(refusal(written(model)) == "accepted");
  }
}

TEST_CASE("net: points with fewer than three edges or more than sixteen are refused on request only",
          "[read][net][error]") {
  ReadOptions strict;
  strict.net.strict = true;
  CHECK(refusal(ring(17)) == "accepted");
  CHECK(refusal(ring(16), strict) == "accepted");
  CHECK(refusal(ring(17), strict) == "a.net:35:1: the point 0 has 17 edges, not 3 to 16");
  CHECK(refusal(ring(3), strict) == "accepted");
  CHECK(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n") == "accepted");
  CHECK(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", strict) ==
        "a.net:4:1: the point 0 has 2 edges, not 3 to 16");
  CHECK(refusal(ring(4) + "v 9 9 9\n", strict) == "a.net: no face uses the point 5");
}

TEST_CASE("net: what is left out or odd gives one warning a kind", "[read][net]") {
  CHECK(warnings(ring(4) + "v 9 9 9\n") == "a.net: warning: point that no triangle uses, left out\n");
  CHECK(warnings("hello\nhello again\n7\n" + ring(4)) ==
        "a.net:1:1: warning: line that begins with 'hello', left out (2 times)\n"
        "a.net:3:1: warning: line that begins with '7', left out\n");
  CHECK(warnings(with(ring(4), "v 0 0 0", "v 0 0 0 1")) ==
        "a.net:1:9: warning: more numbers than the line needs, left out\n");
  CHECK(warnings("v 0 0 0\nv 4 1 0\nv 1 0 0\nv 4 -1 0\nf 0 1 2 3\n").empty());
  CHECK(warnings("v 0 0 0\nv 4 1 0\nv 1 0 0\nv 4 -1 0\nf 3 0 1 2\n") ==
        "a.net:5:1: warning: face that folds over when it is cut into triangles from its first corner\n");
  std::string many;
  for (int i = 0; i < 1000; ++i) many += fmt::format("w{} 1\n", i);
  CHECK(read_model(many + ring(4), "a.net").diagnostics.size() == 9);
}

TEST_CASE("net: centred and scaled to 6 on request", "[read][net]") {
  ReadOptions options;
  options.net.normalise = true;
  const Shell shell = read_model("v 1 2 3\nv 5 2 3\nv 1 4 3\nf 0 1 2\n", "a.net", options).shells[0];
  CHECK(shell.points == std::vector<Point>{{-6, -3, 0}, {6, -3, 0}, {-6, 3, 0}});
  const Shell dot = read_model("v 1 2 3\nv 1 2 3\nv 1 2 3\nf 0 1 2\n", "a.net", options).shells[0];
  CHECK(dot.points == std::vector<Point>(3, Point(0, 0, 0)));
}

TEST_CASE("net: colours follow their points through welding, repair and subdivision", "[read][net]") {
  // A colour that tells where the point is.
  const auto linear = [](const Shell& shell) {
    REQUIRE(shell.point_colors.size() == shell.points.size());
    for (std::size_t v = 0; v < shell.points.size(); ++v) {
      if (shell.point_colors[v].head<3>() != shell.points[v]) return false;
    }
    return true;
  };
  // Two triangles beside each other, with points of their own, and two points that none uses.
  const std::string apart =
      "v 0.5 0.5 1\nv 0 0 0\nv 1 0 0\nv 0 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nc 0.5 0.5 1 1\nc 0 0 0 1\n"
      "c 1 0 0 1\nc 0 0 0 1\nc 0 1 0 1\nc 1 0 0 1\nc 1 1 0 1\nc 0 1 0 1\nf 1 2 4\nf 5 6 7\n";
  ReadOptions weld;
  weld.weld = 0;
  Shell shell = read_model(apart, "a.net", weld).shells[0];
  CHECK(shell.points.size() == 5);
  CHECK(linear(shell));
  repair_shell(shell);
  CHECK(shell.points.size() == 4);
  CHECK(linear(shell));
  const Shell fine = subdivided(read_model(ring(6), "a.net").shells[0], 1);
  CHECK(fine.point_colors.empty());
  Shell colored = read_model(ring(6), "a.net").shells[0];
  for (const Point& p : colored.points) colored.point_colors.push_back({p.x(), p.y(), p.z(), 1});
  const Shell finer = subdivided(colored, 1);
  REQUIRE(finer.point_colors.size() == finer.points.size());
  CHECK(finer.point_colors[7] == 0.5 * (colored.point_colors[0] + colored.point_colors[1]));
}

TEST_CASE("net: every prefix and every flipped bit gives a model or an error", "[read][net][property]") {
  const auto survives = [](const std::string& bytes) {
    try {
      read_model(bytes, "a.net");
    } catch (const Error& error) {
      return error.code() == ErrorCode::BadData;
    }
    return true;
  };
  const std::string cube(kCube);
  for (std::size_t size = 0; size < cube.size(); ++size) CHECK(survives(cube.substr(0, size)));
  for (std::size_t bit = 0; bit < 8 * cube.size(); ++bit) {
    std::string flipped = cube;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
    CHECK(survives(flipped));
  }
}

TEST_CASE("net: a limit on triangles holds", "[read][net][error]") {
  ReadOptions options;
  options.max_triangles = 11;
  CHECK_THROWS_WITH(read_model(kCube, "a.net", options), "a.net: more than 11 triangles, the limit");
}

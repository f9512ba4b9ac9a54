#include <algorithm>
#include <cmath>
#include <limits>

#include "meshcontour/read.hpp"
#include "support/catch.hpp"
#include "support/polygon_samples.hpp"
#include "support/temporary_folder.hpp"

using namespace meshcontour;

namespace {

double area(const Shell& shell) {
  double sum = 0;
  for (const Triangle& t : shell.triangles) {
    const Vector a = shell.points[t[1]] - shell.points[t[0]], b = shell.points[t[2]] - shell.points[t[0]];
    sum += a.cross(b).norm() / 2;
  }
  return sum;
}

Shell read_shell(std::string_view bytes, std::string_view name) {
  return read_model(bytes, name).shells.at(0);
}

std::string with(std::string_view text, std::string_view old, std::string_view replacement) {
  std::string result(text);
  const std::size_t at = result.find(old);
  REQUIRE(at != std::string::npos);
  return result.replace(at, old.size(), replacement);
}

}  // namespace

TEST_CASE("read_model: the same square from every polygon format", "[read][polygon]") {
  for (const auto& [name, bytes] : samples::all()) {
    INFO(name);
    const Model model = read_model(bytes, name);
    const Shell& shell = model.shells.at(0);
    CHECK(shell.points.size() == 4);
    CHECK(shell.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
    CHECK(area(shell) == 1);
    CHECK_FALSE(model.has_patches);
    CHECK(model.instances.size() == 1);
    for (const Diagnostic& d : model.diagnostics) CHECK(d.severity == Diagnostic::Severity::Note);
  }
}

TEST_CASE("read_model: the content decides, whatever the extension", "[read][polygon]") {
  for (const auto& [name, bytes] : samples::all()) {
    INFO(name);
    CHECK(read_shell(bytes, "a.dat").triangles.size() == 2);
    CHECK(read_shell(bytes, "a.xyz").points.size() == 4);
  }
  CHECK(read_shell(with(samples::kOff, "OFF", "   "), "a.off").triangles.size() == 2);
}

TEST_CASE("read_model: CR LF and CR line ends, byte order mark", "[read][polygon]") {
  for (const std::string_view text : {samples::kTextStl, samples::kOff, samples::kObj}) {
    for (const std::string_view end : {"\r\n", "\r"}) {
      std::string bytes;
      for (const char c : text) bytes += c == '\n' ? std::string(end) : std::string(1, c);
      CHECK(read_shell(bytes, "a.stl").triangles.size() == 2);
    }
  }
}

TEST_CASE("STL: corners become points by first appearance, 0 and -0 alike", "[read][polygon]") {
  const Shell shell = read_shell(samples::binary_stl("header"), "a.stl");
  CHECK(shell.points == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  CHECK_FALSE(std::signbit(shell.points[0].x()));
}

TEST_CASE("STL: a file that is read in parts gives the same as from memory", "[read][polygon]") {
  constexpr std::uint32_t kSide = 100;
  std::string bytes(84, ' ');
  const std::uint32_t count = 2 * kSide * kSide;
  std::memcpy(bytes.data() + 80, &count, sizeof count);
  for (std::uint32_t cell = 0; cell < kSide * kSide; ++cell) {
    // Cells far apart follow one another, so that corners come back late.
    const std::uint32_t place = cell * 7919 % (kSide * kSide);
    const auto x = static_cast<float>(place % kSide), y = static_cast<float>(place / kSide);
    const float zero = cell % 2 == 0 ? 0.0f : -0.0f;
    samples::append_facet(bytes, {x, y, zero, x + 1, y, 0, x + 1, y + 1, 0});
    samples::append_facet(bytes, {x, y, 0, x + 1, y + 1, zero, x, y + 1, 0});
  }
  const TemporaryFolder folder;
  write_file(folder / "a.stl", bytes);
  const Shell shell = read_model(folder / "a.stl").shells[0], other = read_shell(bytes, "a.stl");
  CHECK(shell.points.size() == (kSide + 1) * (kSide + 1));
  CHECK(shell.points == other.points);
  CHECK(shell.triangles == other.triangles);
  const float infinity = std::numeric_limits<float>::infinity();
  std::memcpy(bytes.data() + 84 + 50 * 12345 + 16, &infinity, sizeof infinity);
  write_file(folder / "b.stl", bytes);
  CHECK_THROWS_WITH(read_model(folder / "b.stl"), Catch::Contains("facet 12346: a coordinate is not finite"));
}

TEST_CASE("STL: several solids are patches", "[read][polygon]") {
  const std::string two = std::string(samples::kTextStl) + with(samples::kTextStl, "two words", "second");
  const Model model = read_model(with(two, "vertex 1 0 0", "vertex 1 -1 0"), "a.stl");
  CHECK(model.has_patches);
  REQUIRE(model.shells[0].patches.size() == 2);
  CHECK(model.shells[0].patches[0].name == "two words");
  CHECK(model.shells[0].patches[1].name == "second");
  CHECK(model.shells[0].patches[1].first_triangle == 2);
}

TEST_CASE("STL: bytes after the last facet are left out with a warning", "[read][polygon]") {
  const Model model = read_model(samples::binary_stl("x") + "tail", "a.stl");
  CHECK(model.shells[0].triangles.size() == 2);
  REQUIRE(model.diagnostics.size() == 1);
  CHECK(model.diagnostics[0].text() == "a.stl: warning: 4 bytes after the last facet, left out");
}

TEST_CASE("weld: points within the tolerance become one, in every format", "[read][polygon]") {
  ReadOptions options;
  options.weld = 0.01;
  const std::string stl = with(samples::kTextStl, "VERTEX 1 1 0", "VERTEX 1.005 1 0");
  CHECK(read_shell(stl, "a.stl").points.size() == 5);
  CHECK(read_model(stl, "a.stl", options).shells[0].points.size() == 4);
  const std::string_view off = "OFF\n6 2 0\n0 0 0\n1 0 0\n1 1 0\n0 0 0\n1 1 0.001\n0 1 0\n3 0 1 2\n3 3 4 5\n";
  CHECK(read_model(off, "a.off", options).shells[0].triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  options.weld = 0;
  CHECK(read_model(off, "a.off", options).shells[0].points.size() == 5);
  options.weld = -1;
  CHECK_THROWS_AS(read_model(off, "a.off", options), Error);
}

TEST_CASE("OFF: prefixes, colours and a count line without edges", "[read][polygon]") {
  const std::string_view coff =
      "COFF\n4 3\n0 0 0 255 0 0 255\n1 0 0 1 0 0 1\n1 1 0 0 0 0 0\n0 1 0 9 9 9 9\n"
      "3 0 1 2 255 0 0\n3 0 2 3 0 0 255 128\n3 3 2 1 1.0 0 0\n";
  const Model model = read_model(coff, "a.off");
  CHECK(model.has_patches);
  REQUIRE(model.shells[0].patches.size() == 2);
  CHECK(model.shells[0].patches[0].color == Rgba{255, 0, 0, 255});
  CHECK(model.shells[0].patches[0].triangle_count == 2);
  CHECK(model.shells[0].patches[1].color == Rgba{0, 0, 255, 128});
  CHECK(read_shell(with(samples::kOff, "OFF", "STCNOFF"), "a.off").triangles.size() == 2);
  CHECK_THROWS_WITH(read_model("OFF BINARY\nxx", "a.off"), "a.off:1:5: binary OFF is not supported");
  CHECK_THROWS_WITH(read_model("4OFF\n1 1 1\n", "a.off"), Catch::Contains("a.off"));
}

TEST_CASE("OBJ: groups and materials are patches, normals stay with their corners", "[read][polygon]") {
  const std::string text = std::string(samples::kObj) + "g lower\nf 3 2 1\ng upper\nf 4//1 3//1 1//1\n";
  const Model model = read_model(text, "a.obj");
  const Shell& shell = model.shells[0];
  REQUIRE(shell.patches.size() == 2);
  CHECK(shell.patches[0].name == "plate/upper/steel");
  CHECK(shell.patches[1].name == "plate/lower/steel");
  REQUIRE(shell.corner_normals.size() == 3 * shell.triangles.size());
  CHECK(shell.corner_normals[0] == Vector(0, 0, 1));
}

TEST_CASE("PLY: face attributes are patches, a number before a colour", "[read][polygon]") {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 3\nproperty list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\n";
  const std::string points = "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 1\n";
  const Model by_color =
      read_model(header + points + "3 0 1 2 255 0 0\n3 0 2 3 0 255 0\n3 3 1 0 255 0 0\n", "a.ply");
  REQUIRE(by_color.shells[0].patches.size() == 2);
  CHECK(by_color.shells[0].patches[0].triangle_count == 2);
  CHECK(by_color.shells[0].patches[1].color == Rgba{0, 255, 0, 255});
  const Model by_number = read_model(
      header + "property int patch\n" + points + "3 0 1 2 9 9 9 7\n3 0 2 3 9 9 9 -2\n3 3 1 0 9 9 9 5\n",
      "a.ply");
  CHECK(by_number.shells[0].patches.size() == 3);
}

TEST_CASE("PLY: triangle strips", "[read][polygon]") {
  const std::string_view strips =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n9 0 1 2 3 -1 3 1 0 0\n";
  const Shell shell = read_shell(strips, "a.ply");
  CHECK(shell.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {3, 1, 0}});
}

TEST_CASE("polygon files: what is wrong is named with its place", "[read][polygon][error]") {
  const auto message = [](std::string_view bytes, std::string_view name) -> std::string {
    try {
      read_model(bytes, name);
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::BadData);
      return error.what();
    }
    return "accepted";
  };
  using samples::kObj, samples::kOff, samples::kTextPly, samples::kTextStl;
  CHECK(message(with(kTextStl, "vertex 1 0 0", "vertex 1 inf 0"), "a.stl") ==
        "a.stl:5:16: expected a finite number, found 'inf'");
  CHECK(message(with(kTextStl, "endloop", "vertex"), "a.stl") ==
        "a.stl:7:5: expected 'endloop', found 'vertex'");
  CHECK(message(with(kOff, "3\n", "4\n"), "a.off") == "a.off:9:9: expected an index below 4, found '4'");
  CHECK(message(with(kOff, "0 1 2 3", "0 1 2 -1"), "a.off") ==
        "a.off:9:9: expected an index below 4, found '-1'");
  CHECK(message(with(kOff, "1 1 0", "1 nan 0"), "a.off") ==
        "a.off:7:3: expected a finite number, found 'nan'");
  CHECK(message(with(kObj, "-2/1/-1", "-5/1/-1"), "a.obj") ==
        "a.obj:13:14: expected a vertex from 1 to 4 or from -1 to -4, found '-5'");
  CHECK(message(with(kObj, "1/1/1", "0/1/1"), "a.obj") ==
        "a.obj:13:3: expected a vertex from 1 to 4 or from -1 to -4, found '0'");
  CHECK(message(with(kObj, "2//1", "2//99999999999999999999"), "a.obj") ==
        "a.obj:13:9: expected a normal from 1 to 1 or from -1 to -1, found '99999999999999999999'");
  CHECK(message(with(kObj, "v 1 1 0", "v 1 x 0"), "a.obj") ==
        "a.obj:6:5: expected a finite number, found 'x'");
  CHECK(message(with(kTextPly, "4 0 1 2 3", "4 0 1 2 4"), "a.ply") ==
        "a.ply:22:11: vertex 4, but there are 4");
  CHECK(message(with(kTextPly, "1 0 0 255", "1 0 1e999 255"), "a.ply") ==
        "a.ply:19:5: expected a finite number, found '1e999'");
  CHECK(message(with(kTextPly, "property float z", "property float w"), "a.ply") ==
        "a.ply:17:11: vertices need the properties x, y and z");
  std::string binary = samples::binary_ply(false);
  binary.resize(binary.size() - 1);
  CHECK(message(binary, "a.ply") == "a.ply: face 1: a list of 4 items, but only 15 bytes follow");
  std::string infinite = samples::binary_stl("x");
  const float infinity = std::numeric_limits<float>::infinity();
  std::memcpy(infinite.data() + 84 + 50 + 12, &infinity, sizeof infinity);
  CHECK(message(infinite, "a.stl") == "a.stl: facet 2: a coordinate is not finite");
}

TEST_CASE("polygon files: hostile counts are refused before anything is allocated",
          "[read][polygon][error]") {
  std::string stl = samples::binary_stl("x");
  std::memset(stl.data() + 80, 0xFF, 4);
  CHECK_THROWS_WITH(read_model(stl, "a.stl"),
                    "a.stl: neither a text STL file nor a whole binary one: 4294967295 "
                    "facets declared, room for 2");
  CHECK_THROWS_WITH(read_model("OFF\n2000000000 1 0\n", "a.off"),
                    "a.off:2:1: 2000000000 vertices declared, but only 5 bytes follow");
  CHECK_THROWS_WITH(read_model("OFF\n1 4000000000 0\n0 0 0\n", "a.off"),
                    Catch::Contains("4000000000 faces declared"));
  CHECK_THROWS_WITH(read_model("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2000000000 0 1 2\n", "a.off"),
                    Catch::Contains("2000000000 corners declared"));
  CHECK_THROWS_WITH(read_model("OFF\n-3 1 0\n", "a.off"), Catch::Contains("found '-3'"));
  for (const std::string_view format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string ply =
        "ply\nformat " + std::string(format) +
        " 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    CHECK_THROWS_WITH(read_model(ply, "a.ply"), Catch::Contains("4000000000 elements 'vertex' declared"));
  }
  const std::string empty_element =
      "ply\nformat ascii 1.0\nelement nothing 9000000000000000000\nend_header\n";
  CHECK(read_model(empty_element, "a.ply").shells[0].triangles.empty());
  std::string list = samples::binary_ply(false);
  std::memset(list.data() + list.size() - 18, 0xFF, 2);
  CHECK_THROWS_WITH(read_model(list, "a.ply"), Catch::Contains("a list of 65535 items"));
}

TEST_CASE("polygon files: a limit on triangles holds", "[read][polygon][error]") {
  ReadOptions options;
  options.max_triangles = 1;
  for (const auto& [name, bytes] : samples::all()) {
    INFO(name);
    CHECK_THROWS_WITH(read_model(bytes, name, options), name + ": more than 1 triangles, the limit");
  }
}

TEST_CASE("polygon files: strict refuses what would be mended", "[read][polygon][error]") {
  ReadOptions options;
  options.strict = true;
  for (const auto& [name, bytes] : samples::all()) CHECK_NOTHROW(read_model(bytes, name, options));
  CHECK_THROWS_WITH(read_model("OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n5 5 5\n3 0 1 2\n", "a.off", options),
                    "a.off: point that no triangle uses, left out");
}

TEST_CASE("polygon files: coordinates whose squares would not be finite are refused",
          "[read][polygon][error]") {
  const auto triangle = [](const std::string& x) { return "v 0 0 0\nv " + x + " 0 0\nv 0 1 0\nf 1 2 3\n"; };
  CHECK_NOTHROW(read_model(triangle("9e100"), "m.obj"));
  for (const std::string x : {"2e101", "-1e300"}) {
    CHECK_THROWS_WITH(read_model(triangle(x), "m.obj"),
                      Catch::Contains("vertex 1") && Catch::Contains("1e+101"));
  }
}

TEST_CASE("polygon files: every prefix and every flipped bit gives a model or an error",
          "[read][polygon][property]") {
  const auto survives = [](const std::string& bytes, const std::string& name) {
    try {
      read_model(bytes, name);
    } catch (const Error& error) {
      return error.code() == ErrorCode::BadData;
    }
    return true;
  };
  for (const auto& [name, bytes] : samples::all()) {
    INFO(name);
    for (std::size_t size = 0; size < bytes.size(); ++size) CHECK(survives(bytes.substr(0, size), name));
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      std::string flipped = bytes;
      flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
      CHECK(survives(flipped, name));
    }
  }
}

#include <cmath>
#include <random>

#include "read/swp.hpp"
#include "support/catch.hpp"
#include "survey.hpp"

using namespace sweeps;

namespace {

// A model or an error that names the text; anything else escapes and fails the test.
bool readable(const std::string& text) {
  try {
    ReadOptions options;
    options.max_triangles = 100'000;
    options.sweep.caps = true;
    const Model model = read_model(text, "x.swp", options);
    for (const Shell& shell : model.shells) {
      for (const Vector& normal : shell.corner_normals) CHECK(normal.norm() < 1 + 1e-12);
    }
    for (const NamedCurve& curve : model.curves) {
      for (const CurveFrame& frame : curve.frames) CHECK(std::abs(frame.normal.norm() - 1) < 1e-12);
    }
    return true;
  } catch (const Error& error) {
    CHECK(error.code() != ErrorCode::Internal);
    CHECK(std::string(error.what()).starts_with("x.swp"));
    return false;
  }
}

}  // namespace

TEST_CASE("swp: messages say where, what was expected and what was found", "[sweep][error]") {
  const auto [text, message] = GENERATE(table<std::string, std::string>({
      {"circ a 8 1\ncirc a 9 2", "text.swp:2:6: expected a new name, found 'a' again [duplicate-name]"},
      {"circ a 8.5 1", "text.swp:1:8: expected a number of steps, an integer, found '8.5' [bad-integer]"},
      {"circ a 0 1",
       "text.swp:1:8: expected a number of steps from 1 to 4294967295, found '0' [out-of-range]"},
      {"circ a 8 -1", "text.swp:1:10: expected a radius from 0 to 1e+100, found '-1' [out-of-range]"},
      {"circ a 8 1e400", "text.swp:1:10: expected a radius, a finite number, found '1e400' [bad-number]"},
      {"circ a 8", "text.swp:1:9: expected a radius, found the end of the file [unexpected-end]"},
      {"bez2 a 4 5 [0 0]", "text.swp:1:10: expected 4, 7, 10, ... control points, found 5 [bad-count]"},
      {"bez2 a 4 1 [0 0]", "text.swp:1:10: expected 4, 7, 10, ... control points, found 1 [bad-count]"},
      {"bsp3 a 4 4 [0 0 0] (1", "text.swp:1:20: expected '[', found '(1' [expected-bracket]"},
      {"bsp2 a 4 4 [0-1 2]",
       "text.swp:1:13: expected a coordinate, a finite number, found '0-1' [bad-number]"},
      {"bsp2 a 4 4 [[0 2]", "text.swp:1:13: expected a coordinate, a finite number, found '[' [bad-number]"},
      {"circ a 8 1 srev s 8 a srev s 8 a",
       "text.swp:1:28: expected a new name, found 's' again [duplicate-name]"},
      {"circ a 8 1 gcyl s a s",
       "text.swp:1:21: expected a sweep, the name of a curve given before, found 's' [unknown-curve]"},
      {"circ a 8 1 crom2 b",
       "text.swp:1:12: expected one of bez2 bez3 bsp2 bsp3 circ srev gcyl, found 'crom2' [unknown-type]"},
      {"circ a 99999999999999999999 1",
       "text.swp:1:8: expected a number of steps from 1 to 4294967295, found '99999999999999999999' "
       "[out-of-range]"},
  }));
  CHECK_THROWS_WITH(read_text(text), message);
}

TEST_CASE("swp: any character may be part of a name", "[sweep]") {
  CHECK(read_text("circ [a] 8 1 circ \xc3\xa9# 8 3 gcyl a/b [a] \xc3\xa9#").shells.at(0).id == "a/b");
}

TEST_CASE("swp: the first words tell the format", "[sweep]") {
  using detail::Match;
  CHECK(detail::sniff_swp("\r\n bez2 a 4", 0) == Match::Sure);
  CHECK(detail::sniff_swp("# x\ncirc a 8 1", 0) == Match::Possible);
  CHECK(detail::sniff_swp("Bsp2 a", 0) == Match::Possible);
  CHECK(detail::sniff_swp("solid x", 0) == Match::No);
  CHECK(detail::sniff_swp("bez2x", 0) == Match::No);
  CHECK(detail::sniff_swp("", 0) == Match::No);
}

TEST_CASE("swp: promised points and steps take no memory", "[sweep][error]") {
  CHECK_THROWS_WITH(read_text("bez2 a 4 4000000000 [0 0]"), Catch::Contains("unexpected-end"));
  CHECK_NOTHROW(read_text("circ a 4000000000 1"));
  CHECK_NOTHROW(read_text("bez2 a 4294967295 4 [0 0][1 0][1 1][0 1]"));
  try {
    read_text("circ a 4000000000 1 circ b 4000000000 3 gcyl s a b");
    FAIL("was read");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::OutOfMemory);
    CHECK(error.spot().text() == "text.swp:1:41: gcyl s");
  }
}

TEST_CASE("swp: every prefix of a file is a model or an error", "[sweep][error]") {
  for (const std::string name :
       {"beads.swp", "glued.swp", "start_along_z.swp", "torus_cw.swp", "one_line.swp", "knot23.swp"}) {
    const std::string text = data_bytes(name);
    const std::size_t step = text.size() > 500 ? 7 : 1;
    std::size_t models = 0;
    for (std::size_t size = 0; size <= text.size(); size += step)
      models += readable(text.substr(0, size)) ? 1 : 0;
    CHECK(models >= 1);
    CHECK(models < 30);
  }
}

TEST_CASE("swp: random words are a model or an error", "[sweep][error]") {
  const std::vector<std::string> words = {"bez2", "bsp2", "bez3", "bsp3", "circ", "srev",  "gcyl", "a",
                                          "b",    ".",    "[",    "]",    "0",    "1",     "3",    "4",
                                          "7",    "-1",   "1e9",  "0.5",  "nan",  "1e-300"};
  std::mt19937 engine(11);
  for (int i = 0; i < 3000; ++i) {
    std::string text = "circ a 5 1 ";
    for (int k = 0; k < 12; ++k) text += words[engine() % words.size()] + (engine() % 4 != 0 ? " " : "\n");
    readable(text);
  }
}

TEST_CASE("swp: coordinates of any size are a model or an error", "[sweep][error]") {
  std::mt19937 engine(13);
  const std::vector<std::string> numbers = {"0",    "1",      "-2",      "1e100",  "-1e100",
                                            "3e-7", "1e-150", "-1e-300", "4e-324", "1e50"};
  const auto point = [&](int axes) {
    std::string text = "[";
    for (int k = 0; k < axes; ++k) text.append(numbers[engine() % numbers.size()]).append(" ");
    return text.append("]");
  };
  for (int i = 0; i < 1000; ++i) {
    std::string text = "circ c 5 " + numbers[engine() % 2] + " bez2 p 3 4 ";
    for (int k = 0; k < 4; ++k) text.append(point(2));
    text += " bsp3 s 3 5 ";
    for (int k = 0; k < 5; ++k) text.append(point(3));
    INFO(text);
    REQUIRE(readable(text + " gcyl a p s srev b 7 p gcyl d p c gcyl e c s"));
  }
}

TEST_CASE("swp: random curves make valid meshes", "[sweep][property]") {
  std::mt19937 engine(12);
  const auto coordinate = [&] { return std::to_string(static_cast<int>(engine() % 7) - 3) + " "; };
  const auto points = [&](std::size_t count, int axes) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
      text += "[";
      for (int k = 0; k < axes; ++k) text += coordinate();
      text += "]";
    }
    return text;
  };
  for (int i = 0; i < 400; ++i) {
    const bool bezier = engine() % 2 == 0;
    const std::string steps = std::to_string(1 + engine() % 6) + " 7 ";
    const std::string text = (bezier ? "bez2 p " : "bsp2 p ") + steps + points(7, 2) +
                             (engine() % 2 == 0 ? " bez3 s " : " bsp3 s ") + steps + points(7, 3) +
                             " circ c 5 1 srev r 5 p gcyl g p s gcyl h p c";
    INFO(text);
    SweepOptions options;
    options.caps = engine() % 2 == 0;
    options.frames = static_cast<FrameMethod>(engine() % 3);
    for (const Shell& shell : read_text(text, options).shells) {
      for (const Vector& normal : shell.corner_normals) REQUIRE(std::abs(normal.norm() - 0.5) < 0.5 + 1e-12);
      if (shell.triangles.empty()) continue;
      const Survey found = survey(shell);
      REQUIRE(found.bad_edges == 0);
      REQUIRE(found.unused_vertices == 0);
    }
  }
}

#include "support/catch.hpp"
#include "support/run_program.hpp"

using Catch::Contains;

namespace {

const std::string kStud = std::string(MESHCONTOUR_DATA_DIR) + "/stud.xml";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("errors: a bad input gives its code, one clear message and no output", "[cli][error]") {
  const std::string stud = file_text(kStud);
  const std::string vertex = "p=\"0 -15 75\"";
  struct Case {
    std::string name, text, message;
  };
  const Case bad = GENERATE_COPY(values<Case>({
      {"empty", "", "empty"},
      {"not XML",
       "\x7f"
       "ELF\x02\x01\x01",
       "in.xml"},
      {"cut", stud.substr(0, stud.size() / 2), "in.xml:"},
      {"wrong index", replaced(stud, "<f v=\"", "<f v=\"99999 "), "in.xml:"},
      {"NaN", replaced(stud, vertex, "p=\"nan 0 0\""), "nan"},
      {"missing attribute", replaced(stud, vertex, ""), "in.xml:"},
      {"missing child", replaced(stud, "<verts>", "<vertices>"), "in.xml"},
      {"two roots", stud + stud, "in.xml"},
  }));
  CAPTURE(bad.name);
  const TemporaryFolder folder;
  write_file(folder / "in.xml", bad.text);
  const ProgramResult result =
      run_program({"in.xml", "-o", "out.csv", "-o", "out.png"}, {.folder = folder.path().string()});
  CHECK(result.code == 65);
  CHECK_THAT(result.errors, Contains(bad.message) && Contains("in.xml"));
  CHECK(count_lines(result.errors) == 1);
  CHECK(folder.names() == std::set<std::string>{"in.xml"});
}

TEST_CASE("errors: an input that cannot be read has code 66", "[cli][error]") {
  const TemporaryFolder folder;
  const ProgramResult missing = run_program({"absent.xml"}, {.folder = folder.path().string()});
  CHECK(missing.code == 66);
  CHECK_THAT(missing.errors, Contains("absent.xml"));
  const ProgramResult directory = run_program({folder.path().string()});
  CHECK(directory.code == 66);
  CHECK_THAT(directory.errors, Contains("director") || Contains("folder"));
}

TEST_CASE("errors: an output that cannot be created has code 73, one that cannot be written 74",
          "[cli][error]") {
  const TemporaryFolder folder;
  CHECK(run_program({kStud, "-o", folder.path().string() + "/absent/out.csv"}).code == 73);
  CHECK(run_program({kStud, "-o", folder.path().string(), "--format", "csv"}).code == 73);
  const ProgramResult full = run_program({kStud, "-o", "/dev/full", "--format", "csv"});
  CHECK(full.code == 74);
  CHECK_THAT(full.errors, Contains("/dev/full"));
  CHECK(run_program({kStud}, {.output = "/dev/full"}).code == 74);
}

TEST_CASE("errors: without a rasterizer a picture has code 69 and tables are written", "[cli][error]") {
  const TemporaryFolder folder;
  const ProgramOptions bare{.folder = folder.path().string(),
                            .environment = {"MESHCONTOUR_GL_MODULES=" + folder.path().string()}};
  const ProgramResult picture = run_program({kStud, "-o", "out.png", "-o", "out.csv"}, bare);
  CHECK(picture.code == 69);
  CHECK_THAT(picture.errors, Contains("osmesa") && Contains("egl") && Contains("Debian packages"));
  CHECK(count_lines(picture.errors) == 1);
  CHECK(folder.names().empty());
  CHECK(run_program({kStud, "-o", "out.csv"}, bare).code == 0);
}

TEST_CASE("errors: a picture in which nothing would show is none", "[cli][error]") {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_program({kStud, "-o", "out.png", "-o", "out.csv", "--layers", "annotations"},
                  {.folder = folder.path().string()});
  CHECK(result.code == 65);
  CHECK_THAT(result.errors, Contains("nothing to draw"));
  CHECK(folder.names().empty());
}

TEST_CASE("errors: an old output survives a failing run whole", "[cli][error]") {
  const TemporaryFolder folder;
  write_file(folder / "out.csv", "precious");
  write_file(folder / "in.xml", "<step-assembly");
  CHECK(run_program({"in.xml", "-o", "out.csv"}, {.folder = folder.path().string()}).code == 65);
  CHECK(file_text(folder / "out.csv") == "precious");
}

#include "support/catch.hpp"
#include "support/run_program.hpp"

using Catch::Contains;

namespace {

const std::string kStud = std::string(MESHCONTOUR_DATA_DIR) + "/stud.xml";
const std::string kAssembly = std::string(MESHCONTOUR_DATA_DIR) + "/assembly/index.xml";

}  // namespace

TEST_CASE("views: several give a picture each, as one run a view would", "[cli]") {
  const TemporaryFolder folder;
  const ProgramOptions here{.folder = folder.path().string()};
  const ProgramResult result = run_program({kStud, "-o", "{stem}-{view}.png", "-o", "{view}.svg", "-o",
                                            "{stem}.csv", "--view", "top,iso", "--size", "80x60"},
                                           here);
  INFO(result.errors);
  REQUIRE(result.code == 0);
  CHECK(folder.names() ==
        std::set<std::string>{"stud-top.png", "stud-iso.png", "top.svg", "iso.svg", "stud.csv"});
  REQUIRE(
      run_program({kStud, "-o", "one.png", "-o", "one.svg", "--view", "top", "--size", "80x60"}, here).code ==
      0);
  CHECK(file_text(folder / "one.png") == file_text(folder / "stud-top.png"));
  CHECK(file_text(folder / "one.svg") == file_text(folder / "top.svg"));
  CHECK(file_text(folder / "one.png") != file_text(folder / "stud-iso.png"));
}

TEST_CASE("views: several need names that tell them apart", "[cli][error]") {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_program({kStud, "-o", "a.png", "--view", "top,iso"}, {.folder = folder.path().string()});
  CHECK(result.code == 64);
  CHECK_THAT(result.errors, Contains("a.png") && Contains("{view}"));
  CHECK(folder.names().empty());
}

TEST_CASE("layers: colours and widths of theirs are checked", "[cli][error]") {
  for (const auto& [option, value] : {std::pair<std::string, std::string>{"--color", "edges"},
                                      {"--color", "edge=ff0000"},
                                      {"--color", "edges=red"},
                                      {"--color", "edges=ff000080"},
                                      {"--line-width", "edges=0"},
                                      {"--line-width", "edges=65"},
                                      {"--line-width", "edges=nan"},
                                      {"--line-width", "=2"}}) {
    const ProgramResult result = run_program({kStud, option, value});
    INFO(option << ' ' << value);
    CHECK(result.code == 64);
    CHECK_THAT(result.errors, Contains(option));
  }
}

TEST_CASE("samples: a label picture comes by two ways, and from a file of options", "[cli]") {
  const TemporaryFolder folder;
  const ProgramOptions here{.folder = folder.path().string()};
  const auto draw = [&](const std::string& name, std::vector<std::string> options) {
    options.insert(options.end(), {kStud, "-o", name, "--layers", "mesh", "--size", "80x60"});
    const ProgramResult result = run_program(options, here);
    INFO(result.errors);
    REQUIRE(result.code == 0);
    return file_text(folder / name);
  };
  const std::string numbers = draw("numbers.png", {"--color-by", "number"});
  CHECK(draw("plain.png", {"--color-by", "number", "--samples", "1", "--shading", "none"}) == numbers);
  const std::vector<std::string> palette = {"--color-by", "patch", "--samples", "1", "--shading", "none"};
  const std::string labels = draw("labels.png", palette);
  CHECK(labels != numbers);
  CHECK(labels != draw("shaded.png", {"--color-by", "patch", "--samples", "1"}));
  CHECK(labels != draw("mixed.png", {"--color-by", "patch", "--shading", "none"}));
  std::vector<std::string> printing = palette;
  printing.push_back("--print-config");
  write_file(folder / "options.toml", run_program(printing).output);
  CHECK(draw("configured.png", {"--config", "options.toml"}) == labels);
}

TEST_CASE("samples: other words are refused with those that are known", "[cli][error]") {
  for (const std::string value : {"0", "2", "04", "-1", "4x", ""}) {
    const ProgramResult result = run_program({kStud, "--samples", value});
    INFO(value);
    CHECK(result.code == 64);
    CHECK_THAT(result.errors, Contains("--samples") && Contains("1, 4, 16"));
  }
  CHECK(run_program({kStud, "--shading", "flat"}).code == 64);
}

TEST_CASE("units: results are in the unit asked for", "[cli]") {
  const auto loops = [](std::vector<std::string> options) {
    options.insert(options.begin(), {kAssembly, "-o", "-", "--format", "csv"});
    return run_program(options).output;
  };
  CHECK(loops({"--unit", "mm"}) == loops({}));
  CHECK(loops({"--unit", "in"}) != loops({}));
  CHECK(loops({"--input-unit", "in", "--unit", "in"}) == loops({}));
  const std::string dxf = run_program({kStud, "-o", "-", "--format", "dxf", "--unit", "in"}).output;
  CHECK_THAT(dxf, Contains("$INSUNITS\n70\n1\n"));
}

TEST_CASE("units: one that the model does not tell has to be named", "[cli][error]") {
  const TemporaryFolder folder;
  write_file(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string file = (folder / "a.obj").string();
  const ProgramResult unknown = run_program({file, "--unit", "mm"});
  CHECK(unknown.code == 64);
  CHECK_THAT(unknown.errors, Contains("--input-unit"));
  const ProgramResult known =
      run_program({file, "--input-unit", "in", "--unit", "mm", "-o", "-", "--format", "csv"});
  CHECK_THAT(known.output, Contains(",25.4,"));
  CHECK(run_program({file, "--unit", "parsec"}).code == 64);
}

TEST_CASE("messages: GitHub Actions is told file and line", "[cli]") {
  const TemporaryFolder folder;
  write_file(folder / "a,b.xml", "<step-assembly>\n<shape id=\"s\"");
  const ProgramResult result =
      run_program({"a,b.xml", "--messages", "github"}, {.folder = folder.path().string()});
  CHECK(result.code == 65);
  CHECK_THAT(result.errors, Catch::StartsWith("::error file=a%2Cb.xml,line=2,") && Contains("::a,b.xml:2"));
  const ProgramResult absent = run_program({"--messages", "github", "absent.xml"});
  CHECK(absent.code == 66);
  CHECK_THAT(absent.errors, Catch::StartsWith("::error file=absent.xml::"));
}

#include <sstream>

#include "support/catch.hpp"
#include "support/run_program.hpp"

using Catch::Contains;

namespace {

const std::string kStud = std::string(MESHCONTOUR_DATA_DIR) + "/stud.xml";

}  // namespace

TEST_CASE("options: help and version are results on standard output", "[cli]") {
  const ProgramResult help = run_program({"--help"});
  CHECK(help.code == 0);
  CHECK(help.errors.empty());
  CHECK_THAT(help.output, Contains("--layers") && Contains("Exit codes"));
  const ProgramResult version = run_program({"--version"});
  CHECK(version.code == 0);
  CHECK_THAT(version.output, Contains("meshcontour "));
}

TEST_CASE("options: the help fits a terminal of 80 columns", "[cli]") {
  std::istringstream help(run_program({"--help"}).output);
  for (std::string text; std::getline(help, text);) {
    INFO(text);
    CHECK(text.size() <= 80);
  }
}

TEST_CASE("options: the version names the libraries and the renderers", "[cli]") {
  const ProgramResult version = run_program({"--version"});
  CHECK_THAT(version.output, Contains("CGAL ") && Contains("Eigen ") && Contains("OpenGL: "));
}

TEST_CASE("options: a mistyped one is answered with the nearest", "[cli][error]") {
  CHECK_THAT(run_program({"--layer=mesh", kStud}).errors, Contains("did you mean --layers?"));
  CHECK_THAT(run_program({"--tolernace", "1", kStud}).errors, Contains("did you mean --tolerance?"));
  CHECK_THAT(run_program({"--zzzzzzzzzzz", kStud}).errors, !Contains("did you mean"));
}

TEST_CASE("options: a printed configuration can be read back", "[cli]") {
  const TemporaryFolder folder;
  const std::vector<std::string> given = {"--view", "top",      "--fit",  "control",   "-o", "a \"b\".csv",
                                          "-o",     "stud.svg", "--caps", "--patches", "4"};
  std::vector<std::string> printing = given, running = given;
  printing.push_back("--print-config");
  running.push_back(kStud);
  const ProgramResult printed = run_program(printing);
  REQUIRE(printed.code == 0);
  write_file(folder / "options.toml", printed.output);
  const TemporaryFolder direct, configured;
  REQUIRE(run_program(running, {.folder = direct.path().string()}).code == 0);
  const ProgramResult result = run_program({"--config", (folder / "options.toml").string(), kStud},
                                           {.folder = configured.path().string()});
  INFO(result.errors);
  REQUIRE(result.code == 0);
  REQUIRE(configured.names() == direct.names());
  for (const std::string& name : direct.names()) {
    CHECK(file_text(configured / name) == file_text(direct / name));
  }
}

TEST_CASE("options: a configuration that is wrong is refused", "[cli][error]") {
  const TemporaryFolder folder;
  write_file(folder / "bad.toml", "colour = \"red\"\n");
  const ProgramResult unknown =
      run_program({"--config", "bad.toml", kStud}, {.folder = folder.path().string()});
  CHECK(unknown.code == 64);
  CHECK_THAT(unknown.errors, Contains("colour"));
  CHECK(run_program({"--config", "absent.toml", kStud}, {.folder = folder.path().string()}).code == 64);
}

TEST_CASE("options: the manual page and the completions have every option", "[cli]") {
  const std::string help = run_program({"--help"}).output, manual = run_program({"--manual"}).output;
  const std::string bash = run_program({"--completion", "bash"}).output;
  const std::string zsh = run_program({"--completion", "zsh"}).output;
  const std::string fish = run_program({"--completion", "fish"}).output;
  std::size_t count = 0;
  for (std::size_t at = 0; (at = help.find("--", at)) != std::string::npos; ++count) {
    const std::size_t end = std::min(help.find_first_of(" ,=\n", at + 2), help.size());
    const std::string name = help.substr(at + 2, end - at - 2);
    at = end;
    INFO(name);
    std::string escaped;
    for (const char c : "--" + name) escaped += c == '-' ? "\\-" : std::string(1, c);
    CHECK_THAT(manual, Contains(escaped));
    CHECK_THAT(bash, Contains("--" + name));
    CHECK_THAT(zsh, Contains("--" + name + "["));
    CHECK_THAT(fish, Contains("-l " + name));
  }
  CHECK(count > 30);
}

TEST_CASE("options: bash completes options and their words", "[cli]") {
  const TemporaryFolder folder;
  write_file(folder / "completion", run_program({"--completion", "bash"}).output);
  const auto complete = [&](const std::string& words, int position) {
    const std::string command = "bash -c 'source " + (folder / "completion").string() +
                                "; COMP_WORDS=(meshcontour " + words +
                                "); COMP_CWORD=" + std::to_string(position) +
                                "; _meshcontour; echo \"${COMPREPLY[*]}\"' > " + (folder / "reply").string();
    REQUIRE(std::system(command.c_str()) == 0);
    return file_text(folder / "reply");
  };
  CHECK(complete("--vi", 1) == "--view\n");
  CHECK(complete("--view bo", 2) == "bottom\n");
  CHECK(complete("--extractor \"\"", 2) == "sorted halfedge\n");
}

TEST_CASE("options: what cannot be right is refused with its name and exit code 64", "[cli][error]") {
  struct Case {
    std::vector<std::string> arguments;
    std::string message;
  };
  const auto [arguments, message] = GENERATE(values<Case>({
      {{}, "no input"},
      {{"--nonsense", kStud}, "--nonsense"},
      {{kStud, "--layers", ""}, "--layers"},
      {{kStud, "--layers", "foo"}, "one of mesh, edges, curves"},
      {{kStud, "--layers", "mesh,mesh"}, "each word once"},
      {{kStud, "--view", "inside"}, "--view"},
      {{kStud, "--simplify", "0.5"}, "error:LENGTH"},
      {{kStud, "--simplify", "ratio:1.5"}, "at most 1"},
      {{kStud, "--simplify", "error:-1"}, "above zero"},
      {{kStud, "--simplify", "share:0.5"}, "one of error, ratio, triangles"},
      {{kStud, "--size", "0x5"}, "--size"},
      {{kStud, "--size", "16385x1"}, "16384"},
      {{kStud, "--size", "12"}, "--size"},
      {{kStud, "--background", "red"}, "--background"},
      {{kStud, "--patches", "3-1"}, "--patches"},
      {{kStud, "--patches", "0"}, "--patches"},
      {{kStud, "--patches", "99"}, "largest number is 13"},
      {{kStud, "--shell", "id1"}, "no shell 'id1'"},
      {{kStud, "--fit", "best"}, "--fit"},
      {{kStud, "--max-triangles", "-1"}, "--max-triangles"},
      {{kStud, "-o", "out.unknown"}, "no known extension"},
      {{kStud, "-o", "-"}, "--format"},
      {{kStud, "-o", "-", "--format", "doc"}, "--format"},
      {{kStud, kStud, "-o", "same.csv"}, "{stem}"},
      {{kStud, "-o", "a.csv", "-o", "a.csv"}, "named twice"},
  }));
  CAPTURE(arguments);
  const TemporaryFolder folder;
  const ProgramResult result = run_program(arguments, {.folder = folder.path().string()});
  CHECK(result.code == 64);
  CHECK_THAT(result.errors, Contains(message));
  CHECK(result.output.empty());
  CHECK(folder.names().empty());
}

TEST_CASE("options: a selection leaves the other patches out and keeps the numbers", "[cli]") {
  const ProgramResult result = run_program({kStud, "--patches", "4,6-7", "-o", "-", "--format", "csv"});
  REQUIRE(result.code == 0);
  std::set<std::string> patches;
  for (std::size_t line = result.output.find('\n') + 1; line < result.output.size();
       line = result.output.find('\n', line) + 1) {
    const std::size_t comma = result.output.find(',', line);
    patches.insert(result.output.substr(comma + 1, result.output.find(',', comma + 1) - comma - 1));
  }
  CHECK(patches == std::set<std::string>{"4", "6", "7"});
}

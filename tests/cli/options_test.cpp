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

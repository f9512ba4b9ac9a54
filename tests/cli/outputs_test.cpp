#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/run_program.hpp"

using Catch::Contains;

namespace {

const std::string kStud = std::string(MESHCONTOUR_DATA_DIR) + "/stud.xml";

}  // namespace

TEST_CASE("outputs: one run writes every kind", "[cli]") {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_program({kStud, "-o", "stud.png", "-o", "loops.csv", "-o", "loops.obj", "-o", "stud.json",
                   "--report", "timings.json", "--size", "160x120"},
                  {.folder = folder.path().string()});
  INFO(result.errors);
  REQUIRE(result.code == 0);
  CHECK(result.output.empty());
  CHECK(folder.names() ==
        std::set<std::string>{"stud.png", "loops.csv", "loops.obj", "stud.json", "timings.json"});
  CHECK(file_text(folder / "stud.png").starts_with("\x89PNG\r\n"));
  CHECK(count_lines(file_text(folder / "loops.csv")) == 1 + 496);

  const auto json = nlohmann::json::parse(file_text(folder / "stud.json"));
  CHECK(json["model"]["vertices"] == 238);
  CHECK(json["model"]["triangles"] == 472);
  CHECK(json["boundary"]["edges"] == 496);
  CHECK(json["boundary"]["vertices"] == 238);
  CHECK(json["boundary"]["loops"] == 14);
  CHECK(json["patches"].size() == 13);
  CHECK(json["patches"][3]["loops"].size() == 2);

  const auto report = nlohmann::json::parse(file_text(folder / "timings.json"));
  CHECK(report.dump().find("\"read\"") != std::string::npos);
}

TEST_CASE("outputs: without one the summary is printed", "[cli]") {
  const ProgramResult result = run_program({kStud});
  REQUIRE(result.code == 0);
  CHECK(result.errors.empty());
  for (const std::string number : {"238", "472", "13", "496", "14"})
    CHECK_THAT(result.output, Contains(number));
}

TEST_CASE("outputs: text is the same for every thread count, locale, home and working folder", "[cli]") {
  const std::vector<std::string> arguments = {kStud, "-o", "-", "--format", "json"};
  const ProgramResult plain = run_program(arguments);
  REQUIRE(plain.code == 0);
  for (const std::string threads : {"1", "2", "7"}) {
    std::vector<std::string> more = arguments;
    more.insert(more.end(), {"-j", threads});
    CHECK(run_program(more).output == plain.output);
  }
  const ProgramResult bare =
      run_program(arguments, {.folder = "/", .environment = {"PATH=/usr/bin", "LC_ALL=C"}});
  CHECK(bare.output == plain.output);
}

TEST_CASE("outputs: a picture is the same without home, locale and a writable folder", "[cli]") {
  const std::vector<std::string> arguments = {kStud, "-o", "-", "--format", "png", "--size", "160x120"};
  const ProgramResult plain = run_program(arguments);
  REQUIRE(plain.code == 0);
  const ProgramResult bare =
      run_program(arguments, {.folder = "/proc", .environment = {"PATH=/usr/bin", "LC_ALL=C"}});
  CHECK(bare.code == 0);
  CHECK(bare.output == plain.output);
}

TEST_CASE("outputs: a decimal comma in the locale changes nothing", "[cli]") {
  const TemporaryFolder folder;
  const std::string locale = (folder / "de_DE.UTF-8").string();
  if (std::system(("localedef -i de_DE -f UTF-8 '" + locale + "' >/dev/null 2>&1").c_str()) != 0) {
    WARN("skipped: localedef cannot make a locale");
    return;
  }
  const std::vector<std::string> arguments = {kStud, "-o", "-", "--format", "csv"};
  const std::vector<std::string> environment = {"PATH=/usr/bin", "LOCPATH=" + folder.path().string(),
                                                "LC_ALL=de_DE.UTF-8"};
  CHECK(run_program(arguments, {.environment = environment}).output == run_program(arguments).output);
}

TEST_CASE("outputs: several inputs fill the template, and a bad one does not stop the rest", "[cli]") {
  const TemporaryFolder folder;
  write_file(folder / "bad.xml", "<step-assembly");
  std::filesystem::copy(kStud, folder / "first.xml");
  std::filesystem::copy(kStud, folder / "second.xml");
  const ProgramResult result =
      run_program({"first.xml", "bad.xml", "second.xml", "-o", "{dir}/{stem}-{n}.csv"},
                  {.folder = folder.path().string()});
  CHECK(result.code == 1);
  CHECK_THAT(result.errors, Contains("bad.xml") && Contains("3 inputs: 2 done, 1 failed"));
  CHECK(folder.names() ==
        std::set<std::string>{"first.xml", "bad.xml", "second.xml", "first-1.csv", "second-3.csv"});
}

TEST_CASE("outputs: loops are the same whether curves are wanted too or not", "[cli]") {
  const TemporaryFolder folder;
  const ProgramOptions here{.folder = folder.path().string()};
  REQUIRE(run_program({kStud, "-o", "a.csv", "-o", "a.obj"}, here).code == 0);
  REQUIRE(run_program({kStud, "-o", "b.csv", "-o", "b.obj", "-o", "b.step"}, here).code == 0);
  CHECK(file_text(folder / "a.csv") == file_text(folder / "b.csv"));
  CHECK(file_text(folder / "a.obj") == file_text(folder / "b.obj"));
}

TEST_CASE("outputs: standard input is read", "[cli]") {
  const ProgramResult piped = run_program({"-", "-o", "-", "--format", "csv"}, {.input = kStud});
  CHECK(piped.code == 0);
  CHECK(piped.output == run_program({kStud, "-o", "-", "--format", "csv"}).output);
}

TEST_CASE("outputs: a table of a small file needs neither the rasterizer nor threads", "[cli]") {
  const TemporaryFolder folder;
  const std::string trace = (folder / "trace").string();
  const ProgramResult result = run_program({kStud, "-o", "-", "--format", "csv"},
                                           {.environment = {"LD_DEBUG=files", "LD_DEBUG_OUTPUT=" + trace}});
  REQUIRE(result.code == 0);
  std::string log;
  for (const std::string& name : folder.names()) log += file_text(folder / name);
  REQUIRE_THAT(log, Contains("libstdc++"));
  CHECK_THAT(log, !Contains("OSMesa") && !Contains("LLVM") && !Contains("libGL"));
  CHECK_THAT(log, !Contains("tbbmalloc"));  // which TBB looks for when it starts threads
}

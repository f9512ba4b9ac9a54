#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/run_program.hpp"

using Catch::Contains;

namespace {

const std::string kStud = std::string(MESHCONTOUR_DATA_DIR) + "/stud.xml";

// A folder with `count` good models and one bad one in the middle.
void fill(const TemporaryFolder& folder, int count) {
  std::filesystem::create_directory(folder / "in");
  for (int i = 0; i < count; ++i) {
    std::filesystem::copy(kStud, folder / ("in/part" + std::to_string(100 + i) + ".xml"));
  }
  write_file(folder / "in/part100b.xml", "<step-assembly");
  std::filesystem::create_directory(folder / "out");
}

}  // namespace

TEST_CASE("batch: a folder is read in order of names, the bad file is one line", "[cli][batch]") {
  const TemporaryFolder folder;
  fill(folder, 5);
  const std::string workers = GENERATE("1", "2", "4");
  const ProgramResult result =
      run_program({"in", "-o", "out/{stem}.csv", "-j", workers, "--report", "report.json"},
                  {.folder = folder.path().string()});
  CHECK(result.code == 1);
  CHECK_THAT(result.errors, Contains("in/part100b.xml") && Contains("6 inputs: 5 done, 1 failed"));
  const std::string expected = run_program({kStud, "-o", "-", "--format", "csv"}).output;
  for (int i = 0; i < 5; ++i)
    CHECK(file_text(folder / ("out/part" + std::to_string(100 + i) + ".csv")) == expected);

  const std::string report = file_text(folder / "report.json");
  CHECK(count_lines(report) == 6);
  const std::string second = report.substr(report.find('\n') + 1);
  const auto record = nlohmann::json::parse(second.substr(0, second.find('\n')));
  CHECK(record["file"] == "in/part100b.xml");
  CHECK(record["exit_code"] == 65);
}

TEST_CASE("batch: summaries come in the order of the inputs", "[cli][batch]") {
  const TemporaryFolder folder;
  fill(folder, 3);
  const std::vector<std::string> inputs = {"in/part102.xml", "in/part100.xml", "in/part101.xml"};
  const auto run = [&](const std::string& workers) {
    std::vector<std::string> arguments = inputs;
    arguments.insert(arguments.end(), {"-q", "-j", workers, "-o", "-", "--format", "csv"});
    return run_program(arguments, {.folder = folder.path().string()});
  };
  CHECK(run("2").code == 64);  // three results on one standard output
  const ProgramResult counts =
      run_program({inputs[0], inputs[1], inputs[2], "-j", "3"}, {.folder = folder.path().string()});
  CHECK(counts.code == 0);
  CHECK_THAT(counts.output, Contains("238"));
}

TEST_CASE("batch: a journal lets a second run skip what is done", "[cli][batch]") {
  const TemporaryFolder folder;
  fill(folder, 4);
  const std::vector<std::string> arguments = {"in", "-o", "out/{stem}.csv", "--resume", "journal"};
  const ProgramOptions options{.folder = folder.path().string()};
  CHECK_THAT(run_program(arguments, options).errors, Contains("5 inputs: 4 done, 1 failed"));
  std::filesystem::remove(folder / "out/part102.csv");
  write_file(folder / "in/part103.xml", file_text(kStud) + "\n");
  const ProgramResult again = run_program(arguments, options);
  CHECK(again.code == 1);
  CHECK_THAT(again.errors, Contains("2 done, 1 failed, 2 were up to date"));
  CHECK(std::filesystem::exists(folder / "out/part102.csv"));
  std::vector<std::string> other = arguments;
  other.insert(other.end(), {"--csv-of", "curves"});
  CHECK_THAT(run_program(other, options).errors, Contains("4 done, 1 failed"));
}

TEST_CASE("batch: the parts of an array job are disjoint and make the whole", "[cli][batch]") {
  const TemporaryFolder folder;
  fill(folder, 7);
  for (const std::string part : {"1/3", "2/3", "3/3"}) {
    run_program({"in", "-o", "out/" + part.substr(0, 1) + "-{stem}.csv", "--shard", part},
                {.folder = folder.path().string()});
  }
  std::set<std::string> stems;
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
    stems.insert(entry.path().stem().string().substr(2));
    ++files;
  }
  CHECK(files == 7);
  CHECK(stems.size() == 7);
}

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

using Catch::Contains;

TEST_CASE("wavelet: a subdivided mesh is saved, read back and simplified by its details", "[cli]") {
  const std::string stud = std::string(MESHCONTOUR_DATA_DIR) + "/stud.xml";
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "stud.mcw").string();
  CHECK(run_program({stud, "--subdivide", "2", "--save-wavelet", file}).code == 0);
  REQUIRE(std::filesystem::exists(file));
  CHECK(std::filesystem::file_size(file) < 20'000);
  const ProgramResult back = run_program({file, "--simplify", "error:0.5", "-v"});
  CHECK(back.code == 0);
  CHECK_THAT(back.output, Contains("simplified from 7552 triangles"));
  CHECK_THAT(back.errors, Contains("by wavelets on 2 levels"));
  const std::string picture = (folder.path() / "detail.png").string();
  const ProgramResult drawn = run_program({file, "-o", picture, "--layers", "detail", "--size", "200x150"});
  CHECK(drawn.code == 0);
  CHECK(drawn.errors.empty());
  CHECK(std::filesystem::exists(picture));
}

TEST_CASE("wavelet: a mesh that comes from no subdivision is remeshed, unless it must not be", "[cli]") {
  const std::string stud = std::string(MESHCONTOUR_DATA_DIR) + "/stud.xml";
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "stud.mcw").string();
  const ProgramResult saved = run_program({stud, "--save-wavelet", file, "-v"});
  CHECK(saved.code == 0);
  CHECK_THAT(saved.errors, Contains("remeshed from 472 to") && Contains("apart"));
  const ProgramResult back = run_program({file, "-o", "-", "--format", "json"});
  REQUIRE(back.code == 0);
  CHECK(nlohmann::json::parse(back.output)["boundary"]["loops"] == 14);
  const ProgramResult simple = run_program(
      {stud, "--simplify", "error:1", "--simplify-method", "wavelet", "-o", "-", "--format", "json"});
  REQUIRE(simple.code == 0);
  const auto document = nlohmann::json::parse(simple.output);
  CHECK(document["model"]["triangles"] < 350);
  CHECK(document["boundary"]["loops"] == 14);
  CHECK_THAT(document["diagnostics"].dump(), Contains("by wavelets on") && Contains("; remeshed to"));
  const std::string picture = (folder.path() / "detail.png").string();
  const std::vector<std::string> draw = {stud, "-o", picture, "--layers", "detail", "--size", "200x150"};
  const ProgramResult drawn = run_program(draw);
  CHECK(drawn.code == 0);
  CHECK(drawn.errors.empty());
  std::vector<std::string> plain = draw;
  plain.push_back("--no-remesh");
  CHECK_THAT(run_program(plain).errors, Contains("layer detail"));
  const ProgramResult whole = run_program({stud, "--save-wavelet", file, "--no-remesh", "-v"});
  CHECK_THAT(whole.errors, Contains("written as it is"));
}

TEST_CASE("wavelet: details beside a stream are those without one, of the same remesh", "[cli]") {
  const std::string stud = std::string(MESHCONTOUR_DATA_DIR) + "/stud.xml";
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  const std::vector<std::string> draw = {stud, "--layers", "detail", "--size", "200x150", "-v", "-o"};
  std::vector<std::string> alone = draw, beside = draw;
  alone.push_back(path("alone.png"));
  beside.insert(beside.end(), {path("beside.png"), "--save-wavelet", path("stud.mcw")});
  CHECK(run_program(alone).code == 0);
  const ProgramResult both = run_program(beside);
  CHECK(both.code == 0);
  const std::size_t note = both.errors.find("remeshed from");
  REQUIRE(note != std::string::npos);
  CHECK(both.errors.find("remeshed from", note + 1) == std::string::npos);
  CHECK(file_text(path("alone.png")) == file_text(path("beside.png")));
}

TEST_CASE("wavelet: what is no manifold is refused with its reason", "[cli]") {
  const TemporaryFolder folder;
  const std::string fin = (folder.path() / "fin.off").string();
  std::ofstream(fin) << "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 1 4\n";
  const ProgramResult refused = run_program({fin, "--simplify", "ratio:0.5", "--simplify-method", "wavelet"});
  CHECK(refused.code == 65);
  CHECK_THAT(refused.errors, Contains("manifold") && Contains("--repair"));
  const std::string file = (folder.path() / "fin.mcw").string();
  const ProgramResult saved = run_program({fin, "--save-wavelet", file, "-v"});
  CHECK(saved.code == 0);
  CHECK_THAT(saved.errors, Contains("not remeshed"));
}

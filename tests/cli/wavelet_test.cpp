#include <filesystem>

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
  const ProgramResult plain = run_program({stud, "-o", picture, "--layers", "detail", "--size", "200x150"});
  CHECK(plain.code == 0);
  CHECK_THAT(plain.errors, Contains("layer detail"));
  const ProgramResult refused = run_program({stud, "--simplify", "ratio:0.5", "--simplify-method", "wavelet"});
  CHECK(refused.code == 65);
  CHECK_THAT(refused.errors, Contains("--simplify-method qem"));
}

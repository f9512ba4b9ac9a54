// Pictures drawn again: at most 3 levels off on at most 0.1 % of the pixels, which is what the same
// rasterizer differs by from processor to processor.

#include <cstdlib>

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/pictures.hpp"
#include "support/temporary_folder.hpp"

namespace {

constexpr int kLevels = 3;
constexpr double kShare = 0.001;

const std::filesystem::path kGallery = std::filesystem::path(MESHCONTOUR_DATA_DIR) / "gallery";

// Runs a script that draws into a folder, and compares with the pictures that it drew once.
void compare_pictures(const std::filesystem::path& script, const std::filesystem::path& golden) {
  const TemporaryFolder folder;
  const std::string command =
      "MESHCONTOUR='" MESHCONTOUR_PROGRAM "' '" + script.string() + "' '" + folder.path().string() + "'";
  REQUIRE(std::system(command.c_str()) == 0);
  std::set<std::string> expected;
  for (const auto& entry : std::filesystem::directory_iterator(golden)) {
    const std::string name = entry.path().filename().string();
    expected.insert(name);
    INFO(name);
    const double share = pictures::differing_share(pictures::read_png(entry.path()),
                                                   pictures::read_png(folder / name), kLevels);
    CHECK(share <= kShare);
  }
  CHECK(folder.names() == expected);
}

}  // namespace

TEST_CASE("golden: the README's pictures are as they were when somebody looked at them", "[golden]") {
  compare_pictures(MESHCONTOUR_SCRIPTS_DIR "/gallery", kGallery);
}

TEST_CASE("golden: every layer, view, background and colouring is as it was", "[golden]") {
  const std::filesystem::path here = std::filesystem::path(MESHCONTOUR_TESTS_DIR) / "golden";
  compare_pictures(here / "draw_pictures", here / "pictures");
}

TEST_CASE("golden: the comparison tells pictures apart", "[golden]") {
  CHECK(pictures::differing_share(pictures::read_png(kGallery / "report-edges.png"),
                                  pictures::read_png(kGallery / "report-curves.png"), kLevels) > kShare);
}

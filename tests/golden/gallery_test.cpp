// The README's pictures, drawn again: at most 3 levels off on at most 0.1 % of the pixels, which is what the same
// rasterizer differs by from processor to processor.

#include <cstdlib>

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/pictures.hpp"
#include "support/temporary_folder.hpp"

namespace {

constexpr int kLevels = 3;
constexpr double kShare = 0.001;

}  // namespace

TEST_CASE("gallery: every picture is as it was when somebody looked at it", "[golden]") {
  const TemporaryFolder folder;
  const std::string command = "MESHCONTOUR='" MESHCONTOUR_PROGRAM "' '" MESHCONTOUR_SCRIPTS_DIR "/gallery' '" +
                              folder.path().string() + "'";
  REQUIRE(std::system(command.c_str()) == 0);
  const std::filesystem::path golden = std::filesystem::path(MESHCONTOUR_DATA_DIR) / "gallery";
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

TEST_CASE("gallery: the comparison tells pictures apart", "[golden]") {
  const std::filesystem::path golden = std::filesystem::path(MESHCONTOUR_DATA_DIR) / "gallery";
  CHECK(pictures::differing_share(pictures::read_png(golden / "report-edges.png"),
                                  pictures::read_png(golden / "report-curves.png"), kLevels) > kShare);
}

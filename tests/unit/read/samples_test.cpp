// The samples in data/ are what scripts/make_samples writes.

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "meshcontour/read.hpp"
#include "support/catch.hpp"
#include "support/paths.hpp"

using namespace meshcontour;
namespace fs = std::filesystem;

namespace {

std::string whole(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Runs the script; false where there is no Python.
bool make_samples(const std::string& arguments) {
  if (std::system("python3 -c '' >/dev/null 2>&1") != 0) return false;
  REQUIRE(std::system(("python3 " MESHCONTOUR_SCRIPTS_DIR "/make_samples " + arguments).c_str()) == 0);
  return true;
}

}  // namespace

TEST_CASE("samples: made again they are the same bytes", "[read][samples]") {
  const fs::path folder = fs::temp_directory_path() / ("meshcontour_samples_" + std::to_string(::getpid()));
  if (!make_samples("--into " + folder.string())) return;
  for (const char* name : {"stud.xml", "assembly/index.xml", "assembly/shell_id32.xml"}) {
    INFO(name);
    CHECK((whole(folder / name) == whole(fs::path(MESHCONTOUR_DATA_DIR) / name)));
  }
  fs::remove_all(folder);
}

TEST_CASE("samples: one of a given size is about that long, and closed", "[read][samples]") {
  const fs::path file =
      fs::temp_directory_path() / ("meshcontour_sized_" + std::to_string(::getpid()) + ".xml");
  if (!make_samples("--size 2MB --shells 3 " + file.string())) return;
  CHECK(static_cast<double>(fs::file_size(file)) == Approx(2e6).epsilon(0.1));
  const Model model = read_model(file);
  CHECK(model.diagnostics.empty());
  CHECK(model.shells.size() == 3);
  CHECK(model.instances.size() == 3);
  fs::remove(file);
}

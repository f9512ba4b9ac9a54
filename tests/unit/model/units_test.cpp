#include "meshcontour/units.hpp"

#include <filesystem>

#include "meshcontour/read.hpp"
#include "support/catch.hpp"
#include "support/paths.hpp"

using namespace meshcontour;

namespace {

const std::filesystem::path kData = MESHCONTOUR_DATA_DIR;

}  // namespace

TEST_CASE("units: symbols and metres belong together", "[units]") {
  for (const LengthUnit& unit : kLengthUnits) {
    CHECK(metres_of(unit.symbol) == unit.metres);
    CHECK(unit_symbol(unit.metres) == unit.symbol);
  }
  CHECK_FALSE(metres_of("parsec"));
  CHECK(unit_symbol(0).empty());
  CHECK(unit_symbol(0.123).empty());
}

TEST_CASE("units: a converted assembly is as large as before, in other numbers", "[units]") {
  Model model = read_model(kData / "assembly/index.xml");
  REQUIRE(model.metres_per_unit == Approx(1e-3));
  REQUIRE(model.instances.size() > 1);
  const Box before = bounding_box(model);
  const Model original = model;
  convert_units(model, 0.0254);
  const Box after = bounding_box(model);
  CHECK((25.4 * after.min() - before.min()).norm() < 1e-12 * before.diagonal().norm());
  CHECK((25.4 * after.max() - before.max()).norm() < 1e-12 * before.diagonal().norm());
  CHECK(unit_symbol(model.metres_per_unit) == "in");
  convert_units(model, original.metres_per_unit);
  for (std::size_t s = 0; s < model.shells.size(); ++s) {
    for (std::size_t v = 0; v < model.shells[s].points.size(); ++v) {
      CHECK((model.shells[s].points[v] - original.shells[s].points[v]).norm() < 1e-12);
    }
  }
  REQUIRE(model.annotations.size() == original.annotations.size());
}

TEST_CASE("units: curves that the file gives are converted with it", "[units]") {
  Model model = read_model(kData / "samples/swp/unclosed.swp");
  REQUIRE_FALSE(model.curves.empty());
  const double before = length(model.curves.front().curve);
  const Vector frame = model.curves.front().frames.front().position;
  CHECK_THROWS_WITH(convert_units(model, 1), Catch::Contains("--input-unit"));
  model.metres_per_unit = 1e-2;
  convert_units(model, 1);
  CHECK(length(model.curves.front().curve) == Approx(before / 100).epsilon(1e-9));
  CHECK((100 * model.curves.front().frames.front().position - frame).norm() < 1e-12);
}

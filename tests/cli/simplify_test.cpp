#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/run_program.hpp"

using Catch::Contains;

namespace {

const std::string kStud = std::string(MESHCONTOUR_DATA_DIR) + "/stud.xml";

}  // namespace

TEST_CASE("simplify: the distance is in the summary and among the diagnostics", "[cli]") {
  const ProgramResult summary = run_program({kStud, "--simplify", "error:1"});
  CHECK(summary.code == 0);
  CHECK_THAT(summary.output, Contains("simplified from 472 triangles to") && Contains("apart"));
  const ProgramResult json = run_program({kStud, "--simplify", "error:1", "-o", "-", "--format", "json"});
  REQUIRE(json.code == 0);
  const auto document = nlohmann::json::parse(json.output);
  CHECK(document["model"]["triangles"] < 400);
  CHECK(document["boundary"]["loops"] == 14);
  CHECK_THAT(document["diagnostics"].dump(), Contains("by edge collapses, at most"));
}

TEST_CASE("simplify: a number of triangles that patches do not allow is a warning", "[cli]") {
  const ProgramResult result = run_program({kStud, "--simplify", "triangles:5"});
  CHECK(result.code == 0);
  CHECK_THAT(result.errors, Contains("instead of 5"));
}

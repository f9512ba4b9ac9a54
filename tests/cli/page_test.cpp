#include <random>

#include "model_limit.hpp"
#include "support/catch.hpp"
#include "support/run_program.hpp"

using Catch::Contains;

namespace {

const std::string kStud = std::string(MESHCONTOUR_DATA_DIR) + "/stud.xml";

std::size_t occurrences(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++count;
  return count;
}

// A folder with two good files and a broken one, and a batch over it.
struct Batch {
  TemporaryFolder folder;

  Batch() {
    write_file(folder / "bad.xml", "<step-assembly");
    std::filesystem::copy(kStud, folder / "first.xml");
    std::filesystem::copy(kStud, folder / "second.xml");
  }

  ProgramResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"first.xml", "bad.xml", "second.xml"});
    return run_program(arguments, {.folder = folder.path().string()});
  }
};

}  // namespace

TEST_CASE("page: one of all inputs, in their order, with pictures and models", "[cli][page]") {
  const Batch batch;
  REQUIRE(batch.run({"-o", "page.html", "-o", "{stem}.csv"}).code == 1);
  CHECK(batch.folder.names() ==
        std::set<std::string>{"first.xml", "bad.xml", "second.xml", "page.html", "first.csv", "second.csv"});
  const std::string html = file_text(batch.folder / "page.html");
  CHECK(occurrences(html, "<tr data-outcome=") == 3);
  CHECK(occurrences(html, "data:image/png;base64,iVBOR") == 2);
  CHECK(occurrences(html, "\">Z2xURgIAAA") == 2);  // "glTF", version 2
  const std::size_t first = html.find("data-value=\"first.xml\""), bad = html.find("data-value=\"bad.xml\""),
                    second = html.find("data-value=\"second.xml\"");
  CHECK((first < bad && bad < second && second != html.npos));
}

TEST_CASE("page: one of each input where the name tells them apart", "[cli][page]") {
  const Batch batch;
  REQUIRE(batch.run({"-o", "{stem}.html"}).code == 1);
  CHECK(batch.folder.names() ==
        std::set<std::string>{"first.xml", "bad.xml", "second.xml", "first.html", "second.html"});
  const std::string html = file_text(batch.folder / "second.html");
  CHECK_THAT(html, Contains("<h1>second.xml</h1>") && Contains("<details open>"));
  CHECK(occurrences(html, "<tr data-outcome=") == 1);
}

TEST_CASE("page: as a report, and on standard output", "[cli][page]") {
  const TemporaryFolder folder;
  const ProgramOptions options{.folder = folder.path().string()};
  const ProgramResult report = run_program({kStud, "--report", "html:page"}, options);
  CHECK(report.code == 0);
  CHECK(report.output.empty());
  CHECK_THAT(file_text(folder / "page"), Contains("<h1>stud.xml</h1>"));
  const ProgramResult piped = run_program({kStud, "-o", "page.csv", "-o", "-", "--format", "html"}, options);
  CHECK(piped.code == 0);
  CHECK_THAT(piped.output, Contains("<h1>stud.xml</h1>"));
  CHECK(count_lines(file_text(folder / "page.csv")) == 1 + 496);
}

TEST_CASE("page: without a rasterizer it comes without pictures", "[cli][page]") {
  const TemporaryFolder folder;
  const std::vector<std::string> no_renderer = {"MESHCONTOUR_GL_MODULES=/nowhere"};
  const ProgramResult result =
      run_program({kStud, "-o", "page.html"}, {.folder = folder.path().string(), .environment = no_renderer});
  CHECK(result.code == 0);
  const std::string html = file_text(folder / "page.html");
  CHECK_THAT(html, !Contains("<img") && Contains("the page has no picture") && Contains("\">Z2xURgIAAA"));
}

TEST_CASE("page: the models of the first inputs are kept, in whatever order the workers finish",
          "[cli][page]") {
  using meshcontour::FileReport;
  constexpr std::size_t kSize = meshcontour::kLargestPageModels / 10;
  std::vector<std::size_t> order(30);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::mt19937 random(7);
  for (int repetition = 0; repetition < 20; ++repetition) {
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    std::vector<FileReport> reports(order.size());
    meshcontour::app::ModelLimit limit;
    for (const std::size_t job : order) {
      reports[job].preview = {"", "model", job % 3 == 0 ? 3 * kSize / 2 : kSize};
      limit.apply(reports, job);
    }
    for (std::size_t i = 0; i < reports.size(); ++i) {
      INFO(i);
      // 1.5 + 1 + 1 tenths three times are 10.5 tenths: one input fewer fits.
      CHECK(reports[i].preview.model.empty() == (i > 7));
    }
  }
}

TEST_CASE("page: one that cannot be written is found before the work", "[cli][page]") {
  CHECK(run_program({kStud, "-o", "/nowhere/page.html"}).code == 73);
  CHECK(run_program({kStud, "-o", "/nowhere/{stem}.html"}).code == 73);
  const Batch batch;
  const ProgramResult twice = batch.run({"-o", "{dir}.html"});
  CHECK(twice.code == 64);
  CHECK_THAT(twice.errors, Contains("twice"));
}

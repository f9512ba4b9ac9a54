#include "base/base64.hpp"
#include "support/catch.hpp"
#include "unit/report/sample_report.hpp"

using namespace meshcontour;
using Catch::Contains;

namespace {

const std::string kHostile =
    "\"'><script>alert(1)</script><!--\xe2\x80\xa8<img src=x onerror=alert(2)>&lt;\x07\xff</table>";

std::vector<FileReport> pages_of(const std::string& text) {
  std::vector<FileReport> files = sample_reports();
  for (FileReport& file : files) {
    file.file = text;
    file.message = text;
    file.findings = {text, text};
    file.warnings = 2;
    file.preview = {detail::base64("a picture"), detail::base64("a model"), 7};
    for (auto& run : file.runs) run[0].stage = text;
  }
  return files;
}

std::string page(const std::vector<FileReport>& files, const Machine& machine = sample_machine()) {
  StringSink sink;
  write_report(ReportFormat::Html, files, machine, 1'795'305'600, sink);
  return sink.text;
}

// The names of all tags, outside of scripts and styles, and how many attributes each has.
std::vector<std::string> tags_of(const std::string& html) {
  std::vector<std::string> tags;
  for (std::size_t at = html.find('<'); at != html.npos; at = html.find('<', at)) {
    const std::size_t end = html.find('>', at);
    REQUIRE(end != html.npos);
    const std::string tag = html.substr(at, end - at);
    tags.push_back(tag.substr(0, tag.find(' ')) + std::to_string(std::ranges::count(tag, '"')));
    at = end;
    for (const std::string raw : {"script", "style"}) {
      if (tag.starts_with("<" + raw)) at = html.find("</" + raw, at);
    }
  }
  return tags;
}

std::size_t occurrences(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("base64: the vectors of RFC 4648", "[base]") {
  const std::array<std::pair<std::string, std::string>, 7> vectors = {{{"", ""},
                                                                       {"f", "Zg=="},
                                                                       {"fo", "Zm8="},
                                                                       {"foo", "Zm9v"},
                                                                       {"foob", "Zm9vYg=="},
                                                                       {"fooba", "Zm9vYmE="},
                                                                       {"\xff\xfe\xfd", "//79"}}};
  for (const auto& [bytes, text] : vectors) CHECK(detail::base64(bytes) == text);
}

TEST_CASE("report html: no text of a file or machine becomes markup", "[report][html]") {
  Machine hostile = sample_machine();
  hostile.host = hostile.cpu = hostile.system = kHostile;
  const std::string html = page(pages_of(kHostile), hostile);
  CHECK(tags_of(html) == tags_of(page(pages_of("harmless"))));
  CHECK_THAT(html,
             !Contains("alert(1)<") && !Contains("<img src=x") && !Contains("\x07") && !Contains("\xff"));
  CHECK_THAT(html, Contains("&quot;&apos;&gt;&lt;script&gt;alert(1)&lt;/script&gt;"));
}

TEST_CASE("report html: a row a file, with its outcome, numbers, findings and times", "[report][html]") {
  std::vector<FileReport> files = sample_reports();
  files[0].warnings = 1;
  files[0].findings = {"part.xml:3: warning: mended"};
  files[0].deviation = 0.00125;
  files[0].counts.arcs = 77;
  const std::string html = page(files);
  CHECK_THAT(html, Contains("<h1>3 files</h1>") && Contains("1 done, 1 failed, 1 skipped"));
  CHECK(occurrences(html, "<tr data-outcome=") == 3);
  CHECK_THAT(html,
             Contains("data-outcome=\"done\" data-warnings=\"1\"") && Contains("<dt>Arcs</dt><dd>77</dd>"));
  CHECK_THAT(html, Contains("data-label=\"Deviation\" data-value=\"0.00125\">0.00125<"));
  CHECK_THAT(html, Contains("<li>part.xml:3: warning: mended</li>"));
  CHECK_THAT(html, Contains("data-value=\"14.7\">14.70 ms"));  // the median of 13.5 and 15.9
  CHECK_THAT(html, Contains("read 12.70 ms, fit 2.00 ms"));
  CHECK_THAT(html, Contains("width:79.87%") && Contains("width:12.58%"));  // 12.7 and 2 of 15.9
  CHECK_THAT(html, !Contains("/secret/folder"));
}

TEST_CASE("report html: nothing is asked for from elsewhere", "[report][html]") {
  const std::string html = page(pages_of("a.xml"));
  CHECK_THAT(html, Contains("default-src 'none'") && !Contains("http:") && !Contains("https:") &&
                       !Contains("@import"));
  CHECK(occurrences(html, " src=\"") == occurrences(html, " src=\"data:image/png;base64,"));
  CHECK(occurrences(html, " href=\"") == 1);
}

TEST_CASE("report html: a model that was left out is told, and has no view", "[report][html]") {
  std::vector<FileReport> files = pages_of("a.xml");
  for (FileReport& file : files) file.preview.model.clear();
  files[0].preview.model_size = kLargestPreviewModel + 1;
  const std::string html = page(files);
  CHECK_THAT(html, Contains("left out: the model is too large") && !Contains("class=\"view\""));
  files[0].preview.model_size = kLargestPreviewModel;
  CHECK_THAT(page(files), Contains("left out: the page holds enough models"));
}

TEST_CASE("report html: a record keeps what a page shows", "[report][html]") {
  const FileReport file = pages_of(std::string("a\nb"))[0];
  const FileReport again = from_record(to_record(file));
  CHECK(page({again}) == page({file}));
  CHECK_THAT(page({file}), Contains(">YSBtb2RlbA==</script>") && Contains("base64,YSBwaWN0dXJl\""));
}

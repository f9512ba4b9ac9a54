#include <tinyxml2.h>

#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "unit/report/sample_report.hpp"

using namespace meshcontour;
using nlohmann::json;

TEST_CASE("report_format: by name", "[report]") {
  CHECK(report_format("json") == ReportFormat::Json);
  CHECK(report_format("gbench") == ReportFormat::GoogleBenchmark);
  CHECK(report_format("trace") == ReportFormat::Trace);
  CHECK_FALSE(report_format("xml"));
  for (const std::string_view name : report_format_names()) CHECK(report_format(name));
}

TEST_CASE("report json: a line a file, medians, no absolute names", "[report]") {
  const std::string text = reported(ReportFormat::Json, sample_reports());
  CHECK(std::ranges::count(text, '\n') == 3);
  const std::size_t first = text.find('\n'), second = text.find('\n', first + 1);
  const json good = json::parse(text.substr(0, first));
  CHECK(good["file"] == "parts/bracket.xml");
  CHECK(good["outcome"] == "done");
  CHECK(good["wall_ms"] == 14.7);  // between 13.5 and 15.9
  CHECK(good["stages"][0]["stage"] == "read");
  CHECK(good["stages"][0]["wall_ms"] == 12.7);
  CHECK(good["stages"][0]["wall_ms_of_runs"] == json({12.5, 12.9}));
  CHECK(good["counts"]["triangles"] == 20480);
  CHECK(good["peak_memory_bytes"] == 83886080);
  CHECK(good["date"] == "2026-11-22T00:00:00Z");
  CHECK(good["machine"]["cores"] == 2);
  const json bad = json::parse(text.substr(first + 1, second - first - 1));
  CHECK(bad["file"] == "br\"<o>\xef\xbf\xbdken.xml");
  CHECK(bad["exit_code"] == 65);
  CHECK(bad["message"] == "line 17: \"f\" <&> \x1b[31m]]>\n99");
  CHECK(text.find('\x1b') == std::string::npos);
}

TEST_CASE("report gbench: an entry a stage and repetition, stable names", "[report]") {
  const json doc = json::parse(reported(ReportFormat::GoogleBenchmark, sample_reports()));
  CHECK(doc["context"]["date"] == "2026-11-22T00:00:00+00:00");
  CHECK(doc["context"]["num_cpus"] == 2);
  REQUIRE(doc["benchmarks"].size() == 6);
  const json& second = doc["benchmarks"][1];
  CHECK(second["name"] == "read/parts/bracket.xml");
  CHECK(second["run_name"] == second["name"]);
  CHECK(second["repetitions"] == 2);
  CHECK(second["repetition_index"] == 1);
  CHECK(second["real_time"] == 12.9);
  CHECK(second["time_unit"] == "ms");
  CHECK(doc["benchmarks"][4]["name"] == "total/parts/bracket.xml");
  CHECK(doc["benchmarks"][4]["real_time"] == 13.5);
  CHECK(doc["benchmarks"][4]["family_index"] == 2);
}

TEST_CASE("report junit: a case a file, errors with their kind", "[report]") {
  const std::string text = reported(ReportFormat::JUnit, sample_reports());
  tinyxml2::XMLDocument document;
  REQUIRE(document.Parse(text.c_str()) == tinyxml2::XML_SUCCESS);
  const auto* suites = document.FirstChildElement("testsuites");
  REQUIRE(suites != nullptr);
  CHECK(suites->IntAttribute("tests") == 3);
  CHECK(suites->IntAttribute("errors") == 1);
  CHECK(suites->Attribute("skipped") == nullptr);
  const auto* suite = suites->FirstChildElement("testsuite");
  CHECK(suite->IntAttribute("skipped") == 1);
  CHECK(std::string(suite->Attribute("timestamp")) == "2026-11-22T00:00:00");
  const auto* good = suite->FirstChildElement("testcase");
  CHECK(std::string(good->Attribute("classname")) == "parts");
  CHECK(std::string(good->Attribute("name")) == "bracket.xml");
  CHECK(good->DoubleAttribute("time") == 0.029);
  CHECK(good->NoChildren());
  const auto* bad = good->NextSiblingElement("testcase");
  const auto* error = bad->FirstChildElement("error");
  REQUIRE(error != nullptr);
  CHECK(std::string(error->Attribute("type")) == "input");
  CHECK(std::string(error->Attribute("message")) == "line 17: \"f\" <&> \xef\xbf\xbd[31m]]>\n99");
  CHECK(bad->NextSiblingElement("testcase")->FirstChildElement("skipped") != nullptr);
}

TEST_CASE("report junit: how a worker ended is its error's kind", "[report]") {
  const auto [code, type] = GENERATE(table<int, std::string>({{64, "usage"},
                                                              {66, "input"},
                                                              {69, "renderer"},
                                                              {70, "internal"},
                                                              {71, "memory"},
                                                              {73, "output"},
                                                              {74, "output"},
                                                              {75, "time"},
                                                              {139, "crash"},
                                                              {1, "internal"}}));
  auto reports = sample_reports();
  reports[1].exit_code = code;
  CHECK(reported(ReportFormat::JUnit, reports).find("type=\"" + type + "\"") != std::string::npos);
}

TEST_CASE("report gha: medians with their range", "[report]") {
  const json doc = json::parse(reported(ReportFormat::GitHubAction, sample_reports()));
  REQUIRE(doc.size() == 3);
  CHECK(doc[0] == json({{"name", "parts/bracket.xml/read"},
                        {"unit", "ms"},
                        {"value", 12.7},
                        {"range", "\xc2\xb1 0.2"},
                        {"extra", "items: 20480\nruns: 2"}}));
  CHECK(doc[2] == json({{"name", "parts/bracket.xml/peak_rss"}, {"unit", "MB"}, {"value", 80.0}}));
  CHECK(json::parse(reported(ReportFormat::GitHubAction, {})).empty());
}

TEST_CASE("report trace: complete events in microseconds from the first", "[report]") {
  const json doc = json::parse(reported(ReportFormat::Trace, sample_reports()));
  double least = 1e9;
  std::size_t complete = 0;
  for (const json& event : doc["traceEvents"]) {
    if (event["ph"] != "X") continue;
    ++complete;
    least = std::min(least, event["ts"].get<double>());
    if (event["name"] == "read" && event["args"]["file"] == "parts/bracket.xml" && event["ts"] == 10000) {
      CHECK(event["dur"] == 12500);
      CHECK(event["tid"] == 2);
    }
  }
  CHECK(complete == 2 + 2 + 2 + 1 + 1);
  CHECK(least == 0);
  CHECK(json::parse(reported(ReportFormat::Trace, {}))["traceEvents"].size() == 1);
}

TEST_CASE("to_record: comes back as it was", "[report]") {
  for (const FileReport& report : sample_reports()) {
    const std::string line = to_record(report);
    CHECK(line.find('\n') == std::string::npos);
    const FileReport back = from_record(line);
    CHECK(back.file == (report.exit_code == 65 ? "/secret/folder/br\"<o>\xef\xbf\xbdken.xml" : report.file));
    CHECK(back.outcome == report.outcome);
    CHECK(back.message == report.message);
    CHECK(back.counts.triangles == report.counts.triangles);
    CHECK(back.peak_memory == report.peak_memory);
    CHECK(back.worker == report.worker);
    REQUIRE(back.runs.size() == report.runs.size());
    for (std::size_t r = 0; r < back.runs.size(); ++r) {
      REQUIRE(back.runs[r].size() == report.runs[r].size());
      CHECK(back.runs[r][0].stage == report.runs[r][0].stage);
      CHECK(back.runs[r][0].start_ms == report.runs[r][0].start_ms);
      CHECK(back.runs[r][0].wall_ms == report.runs[r][0].wall_ms);
    }
  }
}

TEST_CASE("from_record: anything but a whole record is refused", "[report][error]") {
  const std::string line = to_record(sample_reports()[0]);
  for (std::size_t length = 0; length < line.size(); ++length) {
    CHECK_THROWS_AS(from_record(std::string_view(line).substr(0, length)), Error);
  }
  for (const char* text : {"{}", "[]", "null", "{\"file\":1}", "{\"file\":\"a\",\"outcome\":\"lost\"}"}) {
    CHECK_THROWS_AS(from_record(text), Error);
  }
}

TEST_CASE("this_machine: plausible", "[report]") {
  const Machine machine = this_machine();
  CHECK(machine.cores >= 1);
  CHECK_FALSE(machine.host.empty());
  CHECK_THAT(machine.system, Catch::StartsWith("Linux"));
  CHECK(unix_time() > 1'600'000'000);
}

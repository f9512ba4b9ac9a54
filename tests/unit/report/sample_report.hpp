#pragma once

#include "meshcontour/report.hpp"

namespace meshcontour {

/// One file done twice by worker 1, one that failed with a hostile message, one skipped.
inline std::vector<FileReport> sample_reports() {
  FileReport good;
  good.file = "parts/./bracket.xml";
  good.counts.triangles = 20480;
  good.runs = {{{"read", 1000, 12.5, 12.1, 20480}, {"fit", 1012.5, 1, 2, 14}},
               {{"read", 1020, 12.9, 12.3, 20480}, {"fit", 1032.9, 3, 4, 14}}};
  good.peak_memory = 80 << 20;
  good.worker = 1;
  FileReport bad;
  bad.file = "/secret/folder/br\"<o>\xffken.xml";
  bad.outcome = FileReport::Outcome::Failed;
  bad.exit_code = 65;
  bad.message = "line 17: \"f\" <&> \x1b[31m]]>\n99";
  bad.runs = {{{"read", 990, 2, 2, 0}}};
  FileReport skipped;
  skipped.file = "done.xml";
  skipped.outcome = FileReport::Outcome::Skipped;
  skipped.message = "up to date";
  return {good, bad, skipped};
}

inline Machine sample_machine() {
  return {"ci-runner-7", "Linux 6.1 x86_64", "A processor", 2, 2900, false, {0.5, 0.25, 0.125}};
}

inline std::string reported(ReportFormat format, const std::vector<FileReport>& files) {
  StringSink sink;
  write_report(format, files, sample_machine(), 1'795'305'600, sink);
  return sink.text;
}

}  // namespace meshcontour

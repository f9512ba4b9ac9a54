// Writes a sample report in every format, for other programs to read: export_reports FOLDER

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "unit/report/sample_report.hpp"

int main(int argc, char** argv) {
  using namespace meshcontour;
  if (argc != 2) {
    fmt::print(stderr, "usage: export_reports FOLDER\n");
    return 64;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  for (const std::string_view name : report_format_names()) {
    std::ofstream(folder / name, std::ios::binary) << reported(*report_format(name), sample_reports());
  }
}

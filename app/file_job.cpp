#include "file_job.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "option_values.hpp"

namespace meshcontour::app {
namespace {

std::string format_names() {
  std::string out;
  for (const std::string_view name : output_format_names())
    out += (out.empty() ? "" : ", ") + std::string(name);
  return out;
}

// The names of one input's outputs.
class Names {
 public:
  Names(const std::string& input, std::size_t number, bool several)
      : input_(input), number_(number), several_(several) {}

  std::string path(const std::string& name, std::string_view view = "") const {
    const auto has = [&](std::string_view field) { return name.find(field) != name.npos; };
    if (several_ && name != "-" && !has("{stem}") && !has("{dir}") && !has("{n}")) {
      usage(fmt::format("with several inputs the name of the output '{}' needs {{stem}} or {{n}}",
                        printable(name)));
    }
    return fill_template(name, input_, number_, view);
  }

 private:
  const std::string& input_;
  std::size_t number_;
  bool several_;
};

bool is_seen(OutputFormat format) {
  return format == OutputFormat::Png || format == OutputFormat::Svg;
}

// One output, or one a view.
void add_output(const std::string& name, OutputFormat format, const std::vector<View>& views,
                const Names& names, FileJob& job) {
  if (!is_seen(format)) {
    job.outputs.push_back({names.path(name), format});
    return;
  }
  for (const View view : views)
    job.outputs.push_back({names.path(name, word_of(kViews, view)), format, view});
  if (views.size() > 1 && job.outputs.back().path == job.outputs[job.outputs.size() - 2].path) {
    usage(fmt::format("with several views the name of the output '{}' needs {{view}}", printable(name)));
  }
}

void add_outputs(const CommandLine& line, const Names& names, FileJob& job) {
  auto format = line.formats.begin();
  for (const std::string& name : line.outputs) {
    const std::string path = names.path(name, word_of(kViews, line.views.front()));
    auto known = output_format(extension(path));
    if (!known) {
      if (format == line.formats.end()) {
        usage(fmt::format("the output '{}' has no known extension ({}); name its format with --format",
                          printable(path), format_names()));
      }
      known = output_format(*format);
      if (!known) refuse("--format", *format, "one of " + format_names());
      ++format;
    }
    add_output(name, *known, line.views, names, job);
  }
}

}  // namespace

void set_threads(Job& job, unsigned threads) {
  job.read.threads = job.segment.threads = job.subdivide.threads = job.simplify.threads =
      job.boundary.threads = job.fit.threads = job.render.threads = threads;
}

std::vector<std::string> output_paths(const FileJob& job) {
  std::vector<std::string> paths;
  for (const OutputRequest& output : job.outputs) paths.push_back(output.path);
  for (const MeshRequest& mesh : job.meshes) paths.push_back(mesh.path);
  paths.insert(paths.end(), job.wavelets.begin(), job.wavelets.end());
  paths.insert(paths.end(), job.pages.begin(), job.pages.end());
  return paths;
}

FileJob make_job(const CommandLine& command_line, const std::string& input, std::size_t number,
                 bool several) {
  FileJob job{command_line.job, {}};
  job.input = input;
  job.always_fit = !command_line.reports.empty();
  const Names names(input, number, several);
  add_outputs(command_line, names, job);
  for (const std::string& mesh : command_line.meshes) {
    const std::string path = names.path(mesh);
    const auto known = mesh_format(extension(path));
    if (!known) refuse("--save-mesh", path, "a name that ends with .off, .obj, .stl, .ply or .net");
    job.meshes.push_back({path, *known});
  }
  for (const std::string& wavelet : command_line.wavelets) job.wavelets.push_back(names.path(wavelet));
  for (const std::string& page : command_line.pages) job.pages.push_back(names.path(page));
  const auto is_page = [](const auto& report) { return report.first == ReportFormat::Html; };
  job.preview = !job.pages.empty() || std::ranges::any_of(command_line.reports, is_page);
  return job;
}

}  // namespace meshcontour::app

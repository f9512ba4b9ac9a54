#include "command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <iostream>
#include <limits>
#include <tuple>

#include "choices.hpp"
#include "meshcontour/version.hpp"
#include "option_values.hpp"

namespace meshcontour::app {
namespace {

constexpr const char* kFooter = R"(The kind of an output follows its extension: .png .csv .obj .json
With several inputs use {stem}, {dir} and {n} in the names of the outputs.
Angles are in degrees, lengths in the unit of the model.

Exit codes: 0 ok, 64 usage, 65 bad data, 66 no input, 69 no renderer, 70 internal,
71 out of memory, 73 cannot create, 74 input/output, 75 time limit;
with several inputs: 0 all good, 1 some failed.)";

// Options that are parsed once all are known, as one's default depends on another.
struct PictureTexts {
  std::string layers, size, background;
};

// The options of one group of the help.
class Group {
 public:
  Group(CLI::App& app, std::string name) : app_(app), name_(std::move(name)) {}

  CLI::Option* add_text(const std::string& names, std::string& target, const std::string& kind,
                        const std::string& help) {
    return app_.add_option(names, target, help)->type_name(kind)->group(name_);
  }

  /// Can be repeated; takes one value each time.
  CLI::Option* add_list(const std::string& names, std::vector<std::string>& target, const std::string& kind,
                        const std::string& help) {
    return app_.add_option(names, target, help)->allow_extra_args(false)->type_name(kind)->group(name_);
  }

  CLI::Option* add_flag(const std::string& names, bool& target, const std::string& help) {
    return app_.add_flag(names, target, help)->group(name_);
  }

  CLI::Option* add_action(const std::string& names, const std::function<void()>& action, const std::string& help) {
    return app_.add_flag_callback(names, action, help)->group(name_);
  }

  CLI::Option* add_parsed(const std::string& names, const std::string& kind,
                          const std::function<void(const std::string&)>& parse, const std::string& help) {
    return app_.add_option_function<std::string>(names, parse, help)->type_name(kind)->group(name_);
  }

  /// One word of a table.
  template <class T, std::size_t N>
  CLI::Option* add_choice(const std::string& name, T& target, const Choices<T, N>& choices, const std::string& help) {
    const auto parse = [&target, &choices, name](const std::string& text) {
      target = parse_choice(text, choices, name);
    };
    return add_parsed(name, "WORD", parse, fmt::format("{}: {}", help, words(choices)))
        ->default_str(word_of(choices, target));
  }

  /// A whole number up to `largest`.
  template <class T>
  CLI::Option* add_count(const std::string& name, T& target, const std::string& help,
                         std::uint64_t largest = std::numeric_limits<T>::max()) {
    const auto parse = [&target, name, largest](const std::string& text) {
      target = static_cast<T>(parse_count(text, name, largest));
    };
    return add_parsed(name, "N", parse, help)->default_str(fmt::format("{}", target));
  }

 private:
  CLI::App& app_;
  std::string name_;
};

void add_output_options(Group group, CommandLine& line) {
  group.add_list("-o,--output", line.outputs, "FILE", "File to write, repeatable; - is standard output");
  group.add_list("--format", line.formats, "WORD", "Format of an output without an extension, repeatable");
  group.add_text("--report", line.report, "FILE", "Write counts and the time of each stage, as JSON");
  group.add_flag("--timings", line.job.timings_in_json,
                 "List these times in .json outputs too, whose bytes then differ from run to run");
  group.add_choice("--csv-of", line.job.write.csv, kCsvContents, "Rows of a .csv");
  group.add_choice("--obj", line.job.write.obj, kObjContents, "Contents of an .obj");
}

void add_model_options(Group group, CommandLine& line) {
  const auto parse_patches = [&line](const std::string& text) {
    line.job.selection.patches = parse_ranges(text, "--patches");
  };
  group.add_parsed("--patches", "RANGES", parse_patches, "Only these patches, as in 4,7-9; numbered from 1");
  group.add_text("--shell", line.job.selection.shell, "ID", "Only this shell");
  group.add_flag("--strict", line.job.read.strict, "Anything that would be mended with a warning is an error");
  group.add_count("--max-triangles", line.job.read.max_triangles, "Largest number of triangles over all instances");
  group.add_count("--max-instances", line.job.read.max_instances, "Largest number of placed shells");
}

void add_contour_options(Group group, CommandLine& line) {
  group.add_choice("--extractor", line.job.boundary.extractor, kExtractors, "How boundary edges are found");
  group.add_flag("--compare", line.compare, "Run every extractor, print counts and times, fail if they disagree");
  group.add_choice("--fit", line.job.fit.method, kFitMethods, "How loops become curves");
}

void add_picture_options(Group group, RenderOptions& render, PictureTexts& texts) {
  group.add_text("--layers", texts.layers, "WORDS", fmt::format("What is drawn, in this order: {}", words(kLayers)))
      ->default_str(join_words(render.layers, kLayers));
  group.add_choice("--view", render.view, kViews, "Camera");
  group.add_text("--size", texts.size, "WxH", "Pixels, 1 to 16384 a side; --view report has 500x500")
      ->default_str(fmt::format("{}x{}", render.width, render.height));
  group.add_text("--background", texts.background, "COLOUR", "rrggbb, or none")->default_str("ffffff");
  group.add_choice("--color-by", render.color_by, kColorings, "Colours of the layers");
  group.add_choice("--gl", render.backend, kBackends, "OpenGL context");
}

void add_run_options(Group group, CommandLine& line, unsigned& threads) {
  group.add_count("-j,--threads", threads, "Threads; 0: one per processor", 1024);
  group.add_action("-q,--quiet", [&line] { line.verbosity = -1; }, "Errors only");
  group.add_action("-v,--verbose", [&line] { line.verbosity = 1; }, "Notes too");
}

std::string format_names() {
  std::string out;
  for (const std::string_view name : output_format_names()) out += (out.empty() ? "" : ", ") + std::string(name);
  return out;
}

[[noreturn]] void usage(const std::string& message) {
  throw Error(ErrorCode::Usage, message + "\nTry 'meshcontour --help'.");
}

}  // namespace

std::optional<CommandLine> parse_command_line(int argc, const char* const* argv) {
  CommandLine line;
  PictureTexts texts;
  unsigned threads = 0;
  CLI::App app("Contour curves of tessellated CAD models, headless.", "meshcontour");
  app.set_version_flag("--version", fmt::format("meshcontour {}", version()));
  app.footer(kFooter);
  app.add_option("INPUT", line.inputs, "Files to read; - is standard input")->type_name("FILE");
  add_output_options({app, "Outputs"}, line);
  add_model_options({app, "Model"}, line);
  add_contour_options({app, "Contours"}, line);
  add_picture_options({app, "Pictures"}, line.job.render, texts);
  add_run_options({app, "Run"}, line, threads);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    app.exit(success, std::cout, std::cerr);
    return std::nullopt;
  } catch (const CLI::Error& error) {
    usage(printable(error.what(), 1000));
  }
  if (line.inputs.empty()) usage("no input given");

  RenderOptions& render = line.job.render;
  if (app.count("--layers") > 0) render.layers = parse_choices(texts.layers, kLayers, "--layers");
  if (app.count("--background") > 0) render.background = parse_background(texts.background);
  if (render.view == View::Report) render.width = render.height = 500;
  if (app.count("--size") > 0) std::tie(render.width, render.height) = parse_size(texts.size);
  line.job.read.threads = line.job.boundary.threads = line.job.fit.threads = threads;
  return line;
}

Job make_job(const CommandLine& command_line, const std::string& input, std::size_t number) {
  Job job = command_line.job;
  job.input = input;
  auto format = command_line.formats.begin();
  for (const std::string& output : command_line.outputs) {
    const std::string path = fill_template(output, input, number);
    if (command_line.inputs.size() > 1 && path == output && path != "-") {
      usage(fmt::format("with several inputs the name of the output '{}' needs {{stem}} or {{n}}", printable(output)));
    }
    auto known = output_format(std::filesystem::path(path).extension().string());
    if (!known) {
      if (format == command_line.formats.end()) {
        usage(fmt::format("the output '{}' has no known extension ({}); name its format with --format",
                          printable(path), format_names()));
      }
      known = output_format(*format);
      if (!known) refuse("--format", *format, "one of " + format_names());
      ++format;
    }
    job.outputs.push_back({path, *known});
  }
  return job;
}

}  // namespace meshcontour::app

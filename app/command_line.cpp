#include "command_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <tuple>

#include "choices.hpp"
#include "documentation.hpp"
#include "file_job.hpp"
#include "help.hpp"
#include "meshcontour/version.hpp"
#include "option_group.hpp"
#include "option_values.hpp"

namespace meshcontour::app {
namespace {

constexpr const char* kFooter = R"(The kind of an output follows its extension: .png .csv .obj .step
.dxf .svg .json .glb .wrl .html
With several inputs use {stem}, {dir} and {n} in the names of the outputs; an
.html without them is one page of all inputs. With several views use {view}
in those of pictures.
Angles are in degrees, lengths in the unit of the model.

Exit codes: 0 ok, 64 usage, 65 bad data, 66 no input, 69 no renderer,
70 internal, 71 out of memory, 73 cannot create, 74 input/output, 75 time limit,
130 and 143 interrupted;
with several inputs: 0 all good, 1 some failed.)";

std::string version_text() {
  return fmt::format("meshcontour {}\n{}\nOpenGL: {}", version(), libraries(), fmt::join(renderers(), ", "));
}

// Options that are parsed once all are known, as one's default depends on another.
struct PictureTexts {
  std::string layers, views, size, background;
};

void add_output_options(Group group, CommandLine& line) {
  group.add_list("-o,--output", line.outputs, "FILE", "File to write, repeatable; - is standard output");
  group.add_list("--format", line.formats, "WORD", "Format of an output without an extension, repeatable");
  const auto parse_report = [&line](const std::string& text) {
    line.reports.push_back(parse_report_target(text));
  };
  group.add_each(
      "--report", "[FORMAT:]FILE", parse_report,
      "Write counts and the time of each stage, repeatable: json (default), gbench, junit, gha, trace, html");
  group.add_flag("--timings", line.job.timings_in_json,
                 "List these times in .json outputs too, whose bytes then differ from run to run");
  const auto add_mesh = [&line](const std::string& path) { line.meshes.push_back(path); };
  group.add_each("--save-mesh", "FILE", add_mesh, "Write the mesh, repeatable: .off, .obj, .stl, .ply, .net");
  const auto add_wavelet = [&line](const std::string& path) { line.wavelets.push_back(path); };
  group.add_each(
      "--save-wavelet", "FILE", add_wavelet,
      "Write a progressive wavelet stream (.mcw), repeatable; it can be read back, whole or in part");
  const auto parse_precision = [&line](const std::string& text) {
    line.job.wavelet.precision = parse_positive(text, "--wavelet-precision");
    if (line.job.wavelet.precision >= 1) refuse("--wavelet-precision", text, "a share below 1");
  };
  group
      .add_parsed("--wavelet-precision", "SHARE", parse_precision,
                  "Step of the coefficients in it, of a shell's box diagonal")
      ->default_str(fmt::format("{}", line.job.wavelet.precision));
  group.add_action(
      "--no-remesh", [&line] { line.job.remesh = false; },
      "For it and the layer detail: leave meshes that come from no subdivision as they are");
  group.add_action(
      "--mesh-text", [&line] { line.job.mesh.binary = false; }, "Text instead of binary .stl and .ply");
  group.add_action(
      "--mesh-plain", [&line] { line.job.mesh.patches = false; }, "Triangles only, no patches or colours");
  group.add_flag("--net-float", line.job.mesh.single_precision, "Numbers of a .net in single precision");
  group.add_choice("--csv-of", line.job.write.csv, kCsvContents, "Rows of a .csv");
  group.add_choice("--obj", line.job.write.obj, kObjContents, "Contents of an .obj");
  group.add_choice("--wrl", line.job.write.wrl, kWrlContents, "Lines of a .wrl");
  group.add_choice("--dxf", line.job.write.dxf, kDxfContents, "Entities of a .dxf");
  group.add_choice("--step", line.job.write.step, kStepSchemas, "Schema of a .step");
  group.add_choice("--edges", line.job.write.edges, kEdgeUses,
                   "Edges that two patches share, in .obj curves, .step, .dxf, .svg, .glb");
}

void add_model_options(Group group, CommandLine& line) {
  Job& job = line.job;
  const auto add_unit = [&](const std::string& name, double& metres, const std::string& help) {
    const auto parse = [&metres, name](const std::string& text) { metres = parse_unit(text, name); };
    group.add_parsed(name, "UNIT", parse, help);
  };
  add_unit("--input-unit", job.input_unit, "Unit of the input, whatever it tells: " + unit_symbols());
  add_unit("--unit", job.unit, "Convert lengths to this unit; other options are in it too, but for --weld");
  group.add_choice("--patches-from", job.segment.source, kPatchSources, "Where patches come from");
  group.add_angle("--feature-angle", job.segment.feature_angle, 180,
                  "An edge is sharp above it; for files without patches");
  const auto parse_weld = [&job](const std::string& text) { job.read.weld = parse_length(text, "--weld"); };
  group.add_parsed(
      "--weld", "LENGTH", parse_weld,
      "Join points of polygon files that are no farther apart; without it only STL's equal points");
  group.add_flag("--repair", job.repair, "Cut the surface apart where it is no manifold");
  group.add_count("--subdivide", job.subdivisions,
                  "Steps of butterfly subdivision; contours stay curves of their own", 12);
  group.add_choice("--boundary-rule", job.subdivide.boundary, kBoundaryRules,
                   "Butterfly stencils at borders");
  group.add_choice("--attribute-rule", job.subdivide.attributes, kAttributeRules,
                   "Colours and texture coordinates of the points that subdivision adds");
  const auto parse_simplify = [&job](const std::string& text) { parse_simplification(text, job.simplify); };
  group.add_parsed("--simplify", "GOAL", parse_simplify,
                   "Fewer triangles: error:LENGTH (largest distance), ratio:SHARE or triangles:N");
  group.add_choice("--simplify-method", job.simplify.method, kSimplifyMethods, "How");
  group.add_choice("--frames", job.read.sweep.frames, kFrameMethods, "Frames along the curves of .swp files");
  group.add_flag("--caps", job.read.sweep.caps, "Close the open ends of swept surfaces");
  group.add_flag("--net-normalise", job.read.net.normalise, "Centre a .net and scale it to 6");
  group.add_flag("--strict-net", job.read.net.strict,
                 "Points of a .net have 3 to 16 edges, or it is refused");
  const auto parse_patches = [&line](const std::string& text) {
    line.job.selection.patches = parse_ranges(text, "--patches");
  };
  group.add_parsed("--patches", "RANGES", parse_patches, "Only these patches, as in 4,7-9; numbered from 1");
  group.add_text("--shell", line.job.selection.shell, "ID", "Only this shell");
  const auto add_end = [&](const std::string& name, std::optional<Index>& end, const std::string& help) {
    const auto parse = [&end, name](const std::string& text) {
      end = static_cast<Index>(parse_count(text, name, std::numeric_limits<Index>::max()));
    };
    group.add_parsed(name, "VERTEX", parse, help);
  };
  add_end("--path-from", line.job.path_from,
          "Where the shortest path along edges begins; vertices as in tables");
  add_end("--path-to", line.job.path_to, "Where it ends; its length is a note");
  group.add_flag("--strict", line.job.read.strict,
                 "Anything that would be mended with a warning is an error");
  group.add_count("--max-triangles", line.job.read.max_triangles,
                  "Largest number of triangles over all instances");
  group.add_count("--max-instances", line.job.read.max_instances, "Largest number of placed shells");
}

void add_contour_options(Group group, CommandLine& line) {
  group.add_choice("--extractor", line.job.boundary.extractor, kExtractors, "How boundary edges are found");
  group.add_flag("--compare", line.compare,
                 "Run every extractor, print counts and times, fail if they disagree");
  FitOptions& fit = line.job.fit;
  group.add_choice("--fit", fit.method, kFitMethods, "How loops become curves");
  const auto parse_tolerance = [&fit](const std::string& text) {
    fit.tolerance = parse_positive(text, "--tolerance");
  };
  group.add_parsed("--tolerance", "LENGTH", parse_tolerance,
                   "Largest distance of curve and loop; without it 1e-4 of the loop's box diagonal");
  group.add_angle("--corner-angle", fit.corner_angle, 180, "A loop that turns by more has a corner");
}

void add_picture_options(Group group, RenderOptions& render, PictureTexts& texts) {
  group.add_words("--layers", texts.layers, kLayers, "What is drawn, in this order")
      ->default_str(join_words(render.layers, kLayers));
  group.add_words("--view", texts.views, kViews, "Cameras, a picture each")
      ->default_str(word_of(kViews, render.view));
  group.add_choice("--up", render.up, kUpAxes, "The model's axis that points up, but for --view report");
  group.add_text("--size", texts.size, "WxH", "Pixels, 1 to 16384 a side; --view report alone has 500x500")
      ->default_str(fmt::format("{}x{}", render.width, render.height));
  group.add_text("--background", texts.background, "COLOUR", "rrggbb, or none")->default_str("ffffff");
  group.add_choice(
      "--color-by", render.color_by, kColorings,
      "Colours of the layers; number: of a patch, as rrggbb, without shading, one sample a pixel");
  group.add_choice("--shading", render.shading, kShadings, "Light on faces");
  group.add_choice("--samples", render.samples, kSamples,
                   "Samples a pixel, averaged; with 1 no colours are mixed");
  const auto add_style = [&render](LayerStyle (*parse)(std::string_view)) {
    return [&render, parse](const std::string& text) { render.styles.push_back(parse(text)); };
  };
  group.add_each("--color", "LAYER=rrggbb", add_style(parse_layer_color), "Colour of a layer, repeatable");
  group.add_each("--line-width", "LAYER=PIXELS", add_style(parse_layer_width),
                 "Width of its lines, size of its points, repeatable");
  group.add_choice("--gl", render.backend, kBackends, "OpenGL context");
}

void add_run_options(Group group, CommandLine& line) {
  group.add_count("-j,--jobs", line.threads, "Threads, with several inputs processes; 0: one per processor",
                  1024);
  const auto parse_timeout = [&line](const std::string& text) {
    line.timeout = parse_positive(text, "--timeout");
  };
  group.add_parsed("--timeout", "SECONDS", parse_timeout, "Longest time a file may take");
  const auto parse_memory = [&line](const std::string& text) {
    line.max_memory = parse_bytes(text, "--max-memory");
  };
  group.add_parsed("--max-memory", "SIZE", parse_memory, "Most memory a file may take, as in 500MB or 2GB");
  group.add_text("--resume", line.resume, "JOURNAL",
                 "Remember finished inputs there, and skip those it remembers");
  const auto parse_part = [&line](const std::string& text) { line.shard = parse_shard(text); };
  group.add_parsed("--shard", "I/N", parse_part, "Only the I-th of N parts of the inputs, for array jobs");
  group.add_count("--repeat", line.repeat, "Run every input so often; reports have the medians", 1000);
  group.add_choice("--messages", line.messages, kMessageStyles, "Form of warnings and errors");
  group.add_action(
      "-q,--quiet", [&line] { line.verbosity = -1; }, "Errors only");
  group.add_action(
      "-v,--verbose", [&line] { line.verbosity = 1; }, "Notes too");
}

// Answers instead of a run.
struct Questions {
  bool manual = false, configuration = false;
  std::optional<CommandShell> completion;
};

void add_questions(Group group, OptionTable& table, Questions& questions) {
  const std::string name = kInformation;
  table.parser.set_help_flag("-h,--help", "Print this help")->group(name);
  table.parser
      .set_version_flag("--version", version_text, "Print the version, of libraries too, and the renderers")
      ->group(name);
  group.add_flag("--manual", questions.manual, "Print the manual page: meshcontour --manual | man -l -");
  const auto parse_shell = [&questions](const std::string& text) {
    questions.completion = parse_choice(text, kCommandShells, "--completion");
  };
  group.add_parsed("--completion", "SHELL", parse_shell,
                   "Print the script that completes the command line: " + words(kCommandShells));
  table.parser.set_config("--config", "", "Read options from a TOML file; those of the command line win")
      ->type_name("FILE")
      ->group(name);
  table.parser.allow_config_extras(CLI::config_extras_mode::error);
  group.add_flag("--print-config", questions.configuration, "Print the options as such a file");
}

// Whether a question was asked; prints the answer.
bool answer(const Questions& questions, const OptionTable& table) {
  if (questions.manual) std::cout << manual_page(table);
  if (questions.completion) std::cout << completion_script(table, *questions.completion);
  if (questions.configuration) std::cout << configuration(table);
  return questions.manual || questions.completion || questions.configuration;
}

// Where the layers show a tree or a path and no other contours, that is what an .obj or .wrl is asked to
// hold.
void follow_layers(const CLI::App& app, const std::vector<Layer>& layers, WriteOptions& write) {
  const auto shown = [&](Layer layer) { return std::ranges::find(layers, layer) != layers.end(); };
  if (shown(Layer::Edges) || shown(Layer::Curves)) return;
  const bool tree = shown(Layer::Tree), path = shown(Layer::Path) && !tree;
  if (app.count("--obj") == 0 && tree) write.obj = ObjContent::Tree;
  if (app.count("--obj") == 0 && path) write.obj = ObjContent::Path;
  if (app.count("--wrl") == 0 && path) write.wrl = WrlContent::Path;
}

// Every option that was given and changes results, with its values.
std::string options_text(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    const bool matters = option->count() > 0 && name != "INPUT" && name != "--jobs" && name != "--resume" &&
                         name != "--shard" && name != "--messages" && name != "--report" &&
                         name != "--quiet" && name != "--verbose" && name != "--config";
    if (matters) text += fmt::format("{}={}\n", name, fmt::join(option->results(), ","));
  }
  return text;
}

// Outputs that are pages become reports: one of all inputs, or one of each where the name tells inputs apart.
void take_pages(CommandLine& line) {
  std::vector<std::string> outputs, formats;
  auto format = line.formats.begin();
  for (const std::string& output : line.outputs) {
    const bool named = extension(output) == ".html" || extension(output) == ".htm";
    const bool by_format = !named && !output_format(extension(output)) && format != line.formats.end();
    if (named || (by_format && *format == "html")) {
      if (fill_template(output, "input", 1, "") == output) {
        line.reports.emplace_back(ReportFormat::Html, output);
      } else {
        line.pages.push_back(output);
      }
    } else {
      outputs.push_back(output);
      if (by_format) formats.push_back(*format);
    }
    if (by_format) ++format;
  }
  formats.insert(formats.end(), format, line.formats.end());
  line.outputs = outputs;
  line.formats = formats;
}

// Nothing is left to do when it answers --help or --version.
bool parse(OptionTable& table, int argc, const char* const* argv) {
  try {
    table.parser.parse(argc, argv);
    return true;
  } catch (const CLI::Success& success) {
    table.parser.exit(success, std::cout, std::cerr);
    return false;
  } catch (const CLI::ExtrasError& error) {
    const std::vector<std::string> unknown = table.parser.remaining();
    const std::string nearest = unknown.empty() ? "" : nearest_option(table.parser, unknown.front());
    if (nearest.empty()) usage(printable(error.what(), 1000));
    usage(fmt::format("unknown option '{}'; did you mean {}?", printable(unknown.front(), 200), nearest));
  } catch (const CLI::Error& error) {
    usage(printable(error.what(), 1000));
  }
}

}  // namespace

std::optional<CommandLine> parse_command_line(int argc, const char* const* argv) {
  CommandLine line;
  PictureTexts texts;
  Questions questions;
  OptionTable table;
  CLI::App& app = table.parser;
  app.description("Contour curves of tessellated CAD models, headless.");
  app.name("meshcontour");
  app.formatter(help_formatter());
  app.footer(kFooter);
  app.add_option("INPUT", line.inputs, "Files or folders to read; - is standard input")->type_name("FILE");
  add_output_options({table, "Outputs"}, line);
  add_model_options({table, "Model"}, line);
  add_contour_options({table, "Contours"}, line);
  add_picture_options({table, "Pictures"}, line.job.render, texts);
  add_run_options({table, "Run"}, line);
  add_questions({table, kInformation}, table, questions);
  if (!parse(table, argc, argv) || answer(questions, table)) return std::nullopt;
  if (line.inputs.empty()) usage("no input given");

  RenderOptions& render = line.job.render;
  if (app.count("--layers") > 0) render.layers = parse_choices(texts.layers, kLayers, "--layers");
  follow_layers(app, render.layers, line.job.write);
  if (app.count("--background") > 0) render.background = parse_background(texts.background);
  line.views =
      app.count("--view") > 0 ? parse_choices(texts.views, kViews, "--view") : std::vector{render.view};
  render.view = line.views.front();
  if (line.views == std::vector{View::Report}) render.width = render.height = 500;
  if (app.count("--size") > 0) std::tie(render.width, render.height) = parse_size(texts.size);
  if (line.job.path_from.has_value() != line.job.path_to.has_value())
    usage("a path needs --path-from and --path-to");
  if (line.repeat == 0) refuse("--repeat", "0", "at least 1");
  set_threads(line.job, line.threads);
  line.job.simplify.boundary = line.job.subdivide.boundary;
  line.job.write.up = render.up;
  line.job.wavelet.subdivide = line.job.subdivide;
  line.job.write.timestamp = source_date_epoch().value_or(line.job.write.timestamp);
  line.options_text = options_text(app);
  take_pages(line);
  return line;
}

}  // namespace meshcontour::app

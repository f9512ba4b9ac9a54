#include "meshcontour/pipeline.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>

#include "meshcontour/cleaning.hpp"
#include "meshcontour/graph.hpp"
#include "meshcontour/output.hpp"
#include "meshcontour/remeshing.hpp"
#include "meshcontour/units.hpp"
#include "meshcontour/wavelet.hpp"
#include "pipeline/preview.hpp"
#include "pipeline/selection.hpp"
#include "pipeline/simplification_report.hpp"
#include "write/png.hpp"

namespace meshcontour {
namespace {

constexpr std::string_view extractor_name(Extractor extractor) {
  return extractor == Extractor::Sorted ? "sorted" : "halfedge";
}

// The PNG of every view that an output shows.
using Pictures = std::map<View, std::vector<std::uint8_t>>;

View view_of(const Job& job, const OutputRequest& output) {
  return output.view.value_or(job.render.view);
}

// The remeshes of a model, made when they are asked for first: streams and details share them.
class Remeshes {
 public:
  Remeshes(const Job& job, const Model& model) : job_(job), model_(model) {}

  /// Without any if the job wants none.
  const ModelRemesh& get() {
    if (!made_) {
      RemeshOptions options;
      options.threads = job_.subdivide.threads;
      made_ = job_.remesh ? remeshed_model(model_, options) : ModelRemesh{};
    }
    return *made_;
  }

 private:
  const Job& job_;
  const Model& model_;
  std::optional<ModelRemesh> made_;
};

// The outputs of a job, opened before any work is done.
class Targets {
 public:
  explicit Targets(const Job& job) : job_(job) {
    for (const OutputRequest& output : job.outputs) outputs_.push_back(&set_.open(output.path));
    for (const MeshRequest& mesh : job.meshes) meshes_.push_back(&set_.open(mesh.path));
    for (const std::string& path : job.wavelets) wavelets_.push_back(&set_.open(path));
  }

  /// As the model is at the time.
  void write_wavelets(const Model& model, const ModelRemesh& remesh, std::vector<Diagnostic>& notes) {
    if (wavelets_.empty()) return;
    std::ranges::copy(remesh.notes, std::back_inserter(notes));
    StringSink stream;
    write_wavelet_stream(with_remeshed_shells(model, remesh), job_.wavelet, stream, notes);
    for (Sink* sink : wavelets_) sink->write(stream.text);
  }

  void write(Run& run, const Pictures& pictures) {
    Result result{run.model, run.boundaries, run.contours, extractor_name(job_.boundary.extractor),
                  run.diagnostics};
    if (job_.timings_in_json) result.timings = run.timings.stages();
    std::vector<Diagnostic> notes;
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      if (job_.outputs[i].format == OutputFormat::Png) {
        const std::vector<std::uint8_t>& png = pictures.at(view_of(job_, job_.outputs[i]));
        outputs_[i]->write({reinterpret_cast<const char*>(png.data()), png.size()});
      } else {
        WriteOptions options = job_.write;
        options.view = view_of(job_, job_.outputs[i]);
        write_output(job_.outputs[i].format, result, options, *outputs_[i], notes);
      }
    }
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      write_mesh(job_.meshes[i].format, run.model, job_.mesh, *meshes_[i], notes);
    }
    set_.commit();
    std::ranges::move(notes, std::back_inserter(run.diagnostics));
  }

 private:
  const Job& job_;
  OutputSet set_;
  std::vector<Sink*> outputs_, meshes_, wavelets_;
};

std::string input_name(const Job& job) {
  return job.input == "-" ? "/dev/stdin" : job.input;
}

// Later stages know no file; in a batch every line must name one.
void name_file(const Job& job, Run& run) {
  for (Diagnostic& diagnostic : run.diagnostics) {
    if (diagnostic.spot.file.empty()) diagnostic.spot.file = input_name(job);
  }
}

bool shown(const Job& job, Layer layer, ObjContent obj, WrlContent wrl) {
  return std::ranges::any_of(job.outputs, [&](const OutputRequest& output) {
    return (output.format == OutputFormat::Png &&
            std::ranges::find(job.render.layers, layer) != job.render.layers.end()) ||
           (output.format == OutputFormat::Obj && job.write.obj == obj) ||
           (output.format == OutputFormat::Wrl && job.write.wrl == wrl);
  });
}

void find_lines(const Job& job, Run& run) {
  const bool tree = shown(job, Layer::Tree, ObjContent::Tree, WrlContent::Tree);
  const bool has_ends = job.path_from && job.path_to;
  if (!has_ends &&
      (job.path_from || job.path_to || shown(job, Layer::Path, ObjContent::Path, WrlContent::Path))) {
    throw Error(ErrorCode::Usage, "a path needs --path-from and --path-to");
  }
  if (!tree && !has_ends) return;
  run.timings.measure("lines", [&] {
    if (tree) add_trees(run.model);
    if (has_ends) add_path(run.model, job.selection.shell, *job.path_from, *job.path_to);
  });
  run.timings.count("lines", run.model.tree.size() + run.model.path.size());
}

void find_details(const Job& job, Remeshes& remeshes, Run& run) {
  run.timings.measure("detail", [&] {
    for (std::size_t s = 0; s < run.model.shells.size(); ++s) {
      Shell& shell = run.model.shells[s];
      shell.details = detail_sizes(shell, job.subdivide);
      if (!job.remesh || !shell.details.empty()) continue;
      const std::optional<Remesh>& remesh = remeshes.get().shells[s];
      if (remesh) shell.details = remeshed_detail_sizes(shell, *remesh, job.subdivide);
    }
  });
  const auto plain =
      std::ranges::count_if(run.model.shells, [](const Shell& shell) { return shell.details.empty(); });
  if (plain == 0) return;
  run.model.diagnostics.push_back(
      {Diagnostic::Severity::Warning,
       "layer detail: shell whose triangles come from no subdivision has no details",
       {},
       static_cast<std::size_t>(plain)});
}

// Read, segmented and, where asked for, subdivided.
void make_model(const Job& job, Run& run) {
  run.timings.measure("read", [&] {
    ReadOptions options = job.read;
    options.net.mend = options.net.mend || job.repair;
    run.model = read_model(input_name(job), options);
    if (job.input_unit > 0) run.model.metres_per_unit = job.input_unit;
    if (job.unit > 0) convert_units(run.model, job.unit);
    if (job.repair) repair_model(run.model, job.segment.threads);
  });
  run.timings.count("read", counts_of(run.model, {}, {}).triangles);
  run.timings.measure("segment", [&] {
    segment_model(run.model, job.segment);
    detail::keep_selection(run.model, job.selection);
  });
  if (job.subdivisions > 0) {
    run.timings.measure("subdivide", [&] {
      for (Shell& shell : run.model.shells) shell = subdivided(shell, job.subdivisions, job.subdivide);
    });
  }
  const Counts counts = counts_of(run.model, {}, {});
  run.timings.count("segment", counts.patches);
  if (job.subdivisions > 0) run.timings.count("subdivide", counts.triangles);
}

void analyse_model(const Job& job, Targets& targets, Run& run) {
  Remeshes remeshes(job, run.model);
  if (!job.wavelets.empty()) {
    run.timings.measure("wavelet",
                        [&] { targets.write_wavelets(run.model, remeshes.get(), run.model.diagnostics); });
    run.timings.count("wavelet", counts_of(run.model, {}, {}).triangles);
  }
  if (std::ranges::find(job.render.layers, Layer::Detail) != job.render.layers.end())
    find_details(job, remeshes, run);
}

void prepare_model(const Job& job, Targets& targets, Run& run) {
  make_model(job, run);
  analyse_model(job, targets, run);
  if (job.simplify.goal != SimplifyGoal::None) {
    const std::size_t triangles = counts_of(run.model, {}, {}).triangles;
    run.timings.measure("simplify", [&] { run.simplifications = simplify_model(run.model, job.simplify); });
    run.timings.count("simplify", triangles);
    detail::report_simplifications(job.simplify, run.simplifications, run.model);
  }
  find_lines(job, run);
  run.diagnostics = std::move(run.model.diagnostics);
}

bool shows_contours(const Job& job, const OutputRequest& output) {
  const auto draws = [&](Layer layer) {
    return std::ranges::find(job.render.layers, layer) != job.render.layers.end();
  };
  switch (output.format) {
    case OutputFormat::Png:
      return draws(Layer::Curves) || draws(Layer::Control);
    case OutputFormat::Csv:
      return job.write.csv == CsvContent::Curves;
    case OutputFormat::Obj:
      return job.write.obj == ObjContent::Curves;
    case OutputFormat::Wrl:
      return false;
    default:
      return true;
  }
}

// Without outputs everything is told in a summary.
bool needs_contours(const Job& job) {
  const auto shows = [&](const OutputRequest& output) { return shows_contours(job, output); };
  return job.always_fit || job.preview || (job.outputs.empty() && job.meshes.empty()) ||
         std::ranges::any_of(job.outputs, shows);
}

void find_contours(const Job& job, Run& run) {
  run.timings.measure("boundary",
                      [&] { run.boundaries = extract_boundaries(run.model, job.boundary, run.diagnostics); });
  const Counts counts = counts_of(run.model, run.boundaries, {});
  run.timings.count("boundary", counts.boundary_edges);
  if (!needs_contours(job)) return;
  run.timings.measure(
      "fit", [&] { run.contours = fit_contours(run.model, run.boundaries, job.fit, run.diagnostics); });
  run.timings.count("fit", counts.loops + counts.open_chains);
}

Pictures draw(const Job& job, Run& run) {
  Pictures pictures;
  for (const OutputRequest& output : job.outputs) {
    RenderOptions options = job.render;
    options.view = view_of(job, output);
    if (output.format != OutputFormat::Png || pictures.contains(options.view)) continue;
    const Image image = run.timings.measure(
        "render", [&] { return render(run.model, run.boundaries, run.contours, options); });
    run.timings.measure("write", [&] { pictures.emplace(options.view, encode_png(image)); });
  }
  if (!pictures.empty())
    run.timings.count("render", pictures.size() * counts_of(run.model, {}, {}).triangles);
  return pictures;
}

}  // namespace

Run run(const Job& job) {
  Run run;
  Targets targets(job);
  prepare_model(job, targets, run);
  find_contours(job, run);
  name_file(job, run);
  const Pictures pictures = draw(job, run);
  if (job.preview) run.timings.measure("preview", [&] { run.preview = detail::make_preview(job, run); });
  run.timings.measure("write", [&] { targets.write(run, pictures); });
  name_file(job, run);
  run.timings.count("write", job.outputs.size() + job.meshes.size() + job.wavelets.size());
  return run;
}

}  // namespace meshcontour

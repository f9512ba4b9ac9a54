#include "meshcontour/pipeline.hpp"

#include <algorithm>
#include <iterator>

#include "meshcontour/output.hpp"
#include "pipeline/selection.hpp"
#include "write/png.hpp"

namespace meshcontour {
namespace {

constexpr std::string_view extractor_name(Extractor extractor) {
  return extractor == Extractor::Sorted ? "sorted" : "halfedge";
}

Model read(const Job& job) {
  if (job.input != "-") return read_model(job.input, job.read);
  return read_model(std::filesystem::path("/dev/stdin"), job.read);
}

void take_diagnostics(std::vector<Diagnostic>& from, std::vector<Diagnostic>& to) {
  std::ranges::move(from, std::back_inserter(to));
  from.clear();
}

bool asks_for(const Job& job, OutputFormat format) {
  return std::ranges::any_of(job.outputs, [&](const OutputRequest& output) { return output.format == format; });
}

}  // namespace

Run run(const Job& job) {
  Run run;
  OutputSet outputs;
  std::vector<Sink*> sinks;
  for (const OutputRequest& output : job.outputs) sinks.push_back(&outputs.open(output.path));

  Timings& timings = run.timings;
  timings.measure("read", [&] {
    run.model = read(job);
    detail::keep_selection(run.model, job.selection);
  });
  take_diagnostics(run.model.diagnostics, run.diagnostics);
  const Counts read_counts = counts_of(run.model, {}, {});
  timings.count("read", read_counts.triangles);
  timings.measure("boundary",
                  [&] { run.boundaries = extract_boundaries(run.model, job.boundary, run.diagnostics); });
  timings.measure("fit",
                  [&] { run.contours = fit_contours(run.model, run.boundaries, job.fit, run.diagnostics); });
  const Counts counts = counts_of(run.model, run.boundaries, run.contours);
  timings.count("boundary", counts.boundary_edges);
  timings.count("fit", counts.loops + counts.open_chains);

  std::vector<std::uint8_t> png;
  if (asks_for(job, OutputFormat::Png)) {
    timings.measure("render", [&] {
      png = encode_png(render(run.model, run.boundaries, run.contours, job.render, run.diagnostics));
    });
    timings.count("render", counts.triangles);
  }
  timings.measure("write", [&] {
    for (std::size_t i = 0; i < sinks.size(); ++i) {
      if (job.outputs[i].format == OutputFormat::Png) {
        sinks[i]->write({reinterpret_cast<const char*>(png.data()), png.size()});
        continue;
      }
      Result result{run.model, run.boundaries, run.contours, extractor_name(job.boundary.extractor), run.diagnostics};
      if (job.timings_in_json) result.timings = timings.stages();
      write_output(job.outputs[i].format, result, job.write, *sinks[i], run.diagnostics);
    }
    outputs.commit();
  });
  timings.count("write", job.outputs.size());
  return run;
}

}  // namespace meshcontour

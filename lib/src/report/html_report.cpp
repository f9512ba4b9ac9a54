// One page for people, without anything from the network: a table of the files, and the 3D views of their
// models.

#include <algorithm>

#include "base/timestamp.hpp"
#include "meshcontour/version.hpp"
#include "report/html_assets.hpp"
#include "report/html_row.hpp"

namespace meshcontour::detail {
namespace {

struct StageTotal {
  std::string stage;
  double milliseconds = 0;
};

// Sums over the files, in the order of their first use.
std::vector<StageTotal> stage_totals(std::span<const FileReport> files) {
  std::vector<StageTotal> totals;
  for (const FileReport& report : files) {
    for (const StageSeries& stage : stage_series(report)) {
      auto found = std::ranges::find(totals, stage.stage, &StageTotal::stage);
      if (found == totals.end()) found = totals.insert(found, {stage.stage, 0});
      found->milliseconds += stage.median_wall_ms();
    }
  }
  return totals;
}

double slowest_ms(std::span<const FileReport> files) {
  double slowest = 0;
  for (const FileReport& report : files) {
    for (const auto& run : report.runs) slowest = std::max(slowest, total_wall_ms(run));
  }
  return slowest > 0 ? slowest : 1;
}

std::string counted(std::size_t files) {
  return fmt::format("{} {}", files, files == 1 ? "file" : "files");
}

// Nothing may be loaded, not even if a name got through as markup.
void write_head(const std::string& title, TextWriter& out) {
  out.print(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
      "<title>{} - meshcontour</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n",
      title);
  out.text(kPageCss);
  out.text("</style>\n</head>\n<body>\n");
}

void write_summary(std::span<const FileReport> files, const std::string& title, const Machine& machine,
                   std::int64_t time, TextWriter& out) {
  const auto number = [&](FileReport::Outcome outcome) {
    return std::ranges::count(files, outcome, &FileReport::outcome);
  };
  out.print("<h1>{}</h1>\n<p>{} done, {} failed, {} skipped</p>\n", title, number(FileReport::Outcome::Done),
            number(FileReport::Outcome::Failed), number(FileReport::Outcome::Skipped));
  out.print("<p class=\"note\">meshcontour {}, {} UTC, {} ({}, {} of its processors)</p>\n", version(),
            iso_time(time), html_text(machine.host), html_text(machine.cpu), machine.cores);
}

void write_totals(std::span<const FileReport> files, TextWriter& out) {
  const std::vector<StageTotal> totals = stage_totals(files);
  double sum = 0, longest = 0;
  for (const StageTotal& total : totals) {
    sum += total.milliseconds;
    longest = std::max(longest, total.milliseconds);
  }
  if (!(longest > 0)) return;
  out.print("<h2>Where {} went</h2>\n<table class=\"stages\">\n", duration(sum));
  for (const auto& [stage, milliseconds] : totals) {
    const std::string_view color = stage_class(stage);
    out.print(
        "<tr><th scope=\"row\"><span class=\"key {}\"></span>{}</th><td class=\"number\">{}</td>"
        "<td class=\"number\">{:.0f} %</td><td><div class=\"bars\"><i class=\"{}\" "
        "style=\"width:{:.2f}%\"></i></div></td>"
        "</tr>\n",
        color, html_text(stage), duration(milliseconds), 100 * milliseconds / sum, color,
        100 * milliseconds / longest);
  }
  out.text("</table>\n");
}

constexpr std::string_view kFilters =
    R"(<div class="filters" role="search" aria-label="Files" hidden>
<label>Name <input type="search" id="filter-text"></label>
<label>Outcome <select id="filter-outcome"><option value="">all</option><option>done</option><option>failed</option>
<option>skipped</option></select></label>
<label><input type="checkbox" id="filter-warnings"> with warnings</label>
<span id="shown" role="status" class="muted"></span>
</div>
)";

constexpr std::string_view kViewer =
    R"(<dialog id="viewer" aria-labelledby="viewer-title">
<header><h2 id="viewer-title">3D view</h2><button type="button" id="close">Close</button></header>
<canvas id="canvas" tabindex="0" role="img" aria-label="3D view: arrow keys turn, plus and minus zoom, Home starts again">
</canvas>
<div class="filters"><button type="button" id="spin" aria-pressed="false">Turntable</button>
<label><input type="checkbox" data-layer="mesh" checked> Mesh</label>
<label><input type="checkbox" data-layer="edges" checked> Edges</label>
<label><input type="checkbox" data-layer="curves" checked> Curves</label>
<label><input type="checkbox" data-layer="annotations" checked> Annotations</label>
<span id="viewer-note" role="status"></span></div>
<p class="note">Drag or arrow keys: turn; wheel, pinch, + and -: zoom; Shift and drag: move; Home: start again.</p>
</dialog>
)";

void write_models(std::span<const FileReport> files, TextWriter& out) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (files[i].preview.model.empty()) continue;
    out.print("<script type=\"text/plain\" id=\"model-{}\">", i + 1);
    out.text(files[i].preview.model);
    out.text("</script>\n");
  }
}

}  // namespace

void write_html_report(std::span<const FileReport> files, const Machine& machine, std::int64_t time,
                       Sink& sink) {
  TextWriter out(sink);
  const std::string title =
      files.size() == 1 ? html_text(stable_name(files.front().file)) : counted(files.size());
  write_head(title, out);
  write_summary(files, title, machine, time, out);
  write_totals(files, out);
  out.text("<h2>Files</h2>\n");
  out.print(
      "<p class=\"note\">Deviation: upper bound of the distance of contours and loops, in model units. Time: "
      "median of "
      "the runs. 3D views need WebGL; models up to {} each and {} a page are in it.</p>\n",
      byte_size(kLargestPreviewModel), byte_size(kLargestPageModels));
  out.text(kFilters);
  out.text("<table class=\"files\">\n");
  write_heads(out);
  out.text("<tbody>\n");
  const double slowest = slowest_ms(files);
  for (std::size_t i = 0; i < files.size(); ++i) write_row(files[i], i + 1, slowest, files.size() == 1, out);
  out.text("</tbody>\n</table>\n");
  out.text(kViewer);
  write_models(files, out);
  for (const std::string_view script : {kPageJs, kViewerJs}) {
    out.text("<script>\n");
    out.text(script);
    out.text("</script>\n");
  }
  out.text("</body>\n</html>\n");
  out.flush();
}

}  // namespace meshcontour::detail

#include "report/html_row.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "base/escape.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::array<const char*, 3> kOutcomes = {"done", "failed", "skipped"};

struct Column {
  std::string_view name;
  bool number;
};
constexpr std::array<Column, 9> kColumns = {{{"File", false},
                                             {"Outcome", false},
                                             {"Triangles", true},
                                             {"Patches", true},
                                             {"Loops", true},
                                             {"Segments", true},
                                             {"Deviation", true},
                                             {"Warnings", true},
                                             {"Time", true}}};

double median_wall_ms(const FileReport& report) {
  std::vector<double> totals;
  for (const auto& run : report.runs) totals.push_back(total_wall_ms(run));
  return median(totals);
}

void write_picture(const FileReport& report, const std::string& name, std::size_t number, TextWriter& out) {
  const auto& [picture, model, model_size] = report.preview;
  out.text("<td class=\"picture\">");
  if (!model.empty()) {
    out.print(
        "<button type=\"button\" class=\"view\" data-model=\"model-{0}\" data-name=\"{1}\" aria-label=\"3D "
        "view of {1}\">",
        number, name);
  }
  if (!picture.empty()) {
    out.print("<img alt=\"{}\" width=\"160\" height=\"120\" loading=\"lazy\" src=\"data:image/png;base64,",
              "Picture of " + name);
    out.text(picture);
    out.text("\">");
  }
  if (!model.empty()) out.text("<span>3D view</span></button>");
  if (picture.empty() && model.empty()) out.text("<span class=\"muted\">no picture</span>");
  out.text("</td>\n");
}

void write_number(std::string_view column, double value, const std::string& text, TextWriter& out) {
  out.print("<td class=\"number\" data-label=\"{}\" data-value=\"{}\">{}</td>\n", column, value, text);
}

void write_counts(const FileReport& report, TextWriter& out) {
  const Counts& c = report.counts;
  const std::array<std::pair<std::string_view, std::uint64_t>, 14> facts = {
      {{"Shells", c.shells},
       {"Instances", c.instances},
       {"Patches", c.patches},
       {"Vertices", c.vertices},
       {"Triangles", c.triangles},
       {"Boundary vertices", c.boundary_vertices},
       {"Boundary edges", c.boundary_edges},
       {"Loops", c.loops},
       {"Open chains", c.open_chains},
       {"Lines", c.lines},
       {"Arcs", c.arcs},
       {"Circles", c.circles},
       {"Ellipses", c.ellipses},
       {"Splines", c.splines}}};
  out.text("<dl class=\"facts\">");
  for (const auto& [name, value] : facts) out.print("<dt>{}</dt><dd>{}</dd>", name, value);
  if (report.peak_memory > 0) out.print("<dt>Peak memory</dt><dd>{}</dd>", byte_size(report.peak_memory));
  const Preview& preview = report.preview;
  if (preview.model.empty() && preview.model_size > 0) {
    out.print("<dt>3D view</dt><dd>left out: {}</dd>", preview.model_size > kLargestPreviewModel
                                                           ? "the model is too large"
                                                           : "the page holds enough models");
  }
  out.text("</dl>\n");
}

void write_bar(std::string_view stage, double share, TextWriter& out) {
  out.print("<i class=\"{}\" style=\"width:{:.2f}%\"></i>", stage_class(stage),
            100 * std::clamp(share, 0.0, 1.0));
}

void write_stages(const std::vector<StageSeries>& stages, TextWriter& out) {
  double longest = 0;
  for (const StageSeries& stage : stages) longest = std::max(longest, stage.median_wall_ms());
  if (!(longest > 0)) return;
  out.text("<table class=\"stages\"><caption class=\"note\">Time of each stage</caption>");
  for (const StageSeries& stage : stages) {
    out.print("<tr><th scope=\"row\">{}</th><td class=\"number\">{}</td><td><div class=\"bars\">",
              html_text(stage.stage), duration(stage.median_wall_ms()));
    write_bar(stage.stage, stage.median_wall_ms() / longest, out);
    out.text("</div></td></tr>\n");
  }
  out.text("</table>\n");
}

void write_details(const FileReport& report, const std::vector<StageSeries>& stages, bool open,
                   TextWriter& out) {
  if (report.runs.empty() && report.findings.empty()) return;
  out.print("<details{}><summary>Details</summary>\n", open ? " open" : "");
  if (report.outcome == FileReport::Outcome::Done) write_counts(report, out);
  write_stages(stages, out);
  if (!report.findings.empty()) {
    out.text("<ul class=\"findings\">");
    for (const std::string& finding : report.findings) out.print("<li>{}</li>\n", html_text(finding));
    out.text("</ul>");
  }
  out.text("</details>");
}

void write_time(const FileReport& report, const std::vector<StageSeries>& stages, double slowest,
                TextWriter& out) {
  const double total = median_wall_ms(report);
  std::string label;
  for (const StageSeries& stage : stages) {
    label += fmt::format("{}{} {}", label.empty() ? "" : ", ", stage.stage, duration(stage.median_wall_ms()));
  }
  out.print("<td class=\"number\" data-label=\"Time\" data-value=\"{}\">{}", rounded(total),
            stages.empty() ? "" : duration(total));
  if (!stages.empty()) {
    out.print("<div class=\"bars\" role=\"img\" aria-label=\"{0}\" title=\"{0}\">", html_text(label));
    for (const StageSeries& stage : stages) write_bar(stage.stage, stage.median_wall_ms() / slowest, out);
    out.text("</div>");
  }
  out.text("</td></tr>\n");
}

}  // namespace

std::string html_text(std::string_view text) {
  return xml_escaped(printable(text, std::numeric_limits<std::size_t>::max()));
}

std::string duration(double milliseconds) {
  if (milliseconds >= 10'000) return fmt::format("{:.1f} s", milliseconds / 1000);
  return milliseconds >= 100 ? fmt::format("{:.0f} ms", milliseconds)
                             : fmt::format("{:.2f} ms", milliseconds);
}

std::string byte_size(std::uint64_t bytes) {
  if (bytes < 10'000) return fmt::format("{} bytes", bytes);
  if (bytes < 1'000'000) return fmt::format("{:.0f} kB", static_cast<double>(bytes) / 1e3);
  return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
}

std::string_view stage_class(std::string_view stage) {
  constexpr std::array<std::string_view, 8> kStages = {"read", "segment", "subdivide", "boundary",
                                                       "fit",  "render",  "preview",   "write"};
  const auto known = std::ranges::find(kStages, stage);
  return known == kStages.end() ? std::string_view() : *known;
}

void write_heads(TextWriter& out) {
  out.text("<thead><tr><th scope=\"col\">Picture</th>");
  for (const auto& [name, number] : kColumns) {
    out.print("<th scope=\"col\" aria-sort=\"none\"{}><button type=\"button\">{}</button></th>",
              number ? " class=\"number\"" : "", name);
  }
  out.text("</tr></thead>\n");
}

void write_row(const FileReport& report, std::size_t number, double slowest, bool open, TextWriter& out) {
  const std::vector<StageSeries> stages = stage_series(report);
  const std::string name = html_text(stable_name(report.file));
  const char* outcome = kOutcomes[static_cast<std::size_t>(report.outcome)];
  out.print("<tr data-outcome=\"{}\" data-warnings=\"{}\">\n", outcome, report.warnings);
  write_picture(report, name, number, out);
  out.print("<th scope=\"row\" data-value=\"{0}\">{0}\n", name);
  if (!report.message.empty())
    out.print("<p class=\"message {}\">{}</p>\n", outcome, html_text(report.message));
  write_details(report, stages, open, out);
  out.print("</th>\n<td data-label=\"Outcome\" data-value=\"{0}\" class=\"{0}\">{0}</td>\n", outcome);
  const bool done = report.outcome == FileReport::Outcome::Done;
  const Counts& c = report.counts;
  for (const auto& [column, count] : {std::pair{"Triangles", c.triangles},
                                      {"Patches", c.patches},
                                      {"Loops", c.loops},
                                      {"Segments", c.segments}}) {
    write_number(column, done ? static_cast<double>(count) : -1, done ? fmt::format("{}", count) : "", out);
  }
  write_number("Deviation", done ? report.deviation : -1, done ? fmt::format("{:.3g}", report.deviation) : "",
               out);
  write_number("Warnings", static_cast<double>(report.warnings), fmt::format("{}", report.warnings), out);
  write_time(report, stages, slowest, out);
}

}  // namespace meshcontour::detail

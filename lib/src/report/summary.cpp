#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>

#include "meshcontour/report.hpp"

namespace meshcontour {
namespace {

constexpr std::size_t kMostPatches = 40;  // listed one by one
constexpr std::size_t kMostLoops = 6;     // whose lengths are listed
constexpr std::size_t kMostFindings = 20;

// Rows of cells, printed in columns as wide as their widest cell; the first row is the heading.
class Table {
 public:
  enum Align { Left, Right };

  explicit Table(std::vector<Align> columns) : columns_(std::move(columns)) {}

  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

  std::string text() const {
    std::vector<std::size_t> widths(columns_.size(), 0);
    for (const auto& row : rows_) {
      for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
    }
    std::string out;
    for (const auto& row : rows_) {
      std::string line;
      for (std::size_t c = 0; c < row.size(); ++c) {
        if (c > 0) line += "  ";
        line += columns_[c] == Left ? fmt::format("{:<{}}", row[c], widths[c])
                                    : fmt::format("{:>{}}", row[c], widths[c]);
      }
      line.erase(line.find_last_not_of(' ') + 1);
      out += line + '\n';
    }
    return out;
  }

 private:
  std::vector<Align> columns_;
  std::vector<std::vector<std::string>> rows_;
};

std::string number(std::uint64_t value) {
  return fmt::format("{}", value);
}

std::string plural(std::uint64_t count, std::string_view singular, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? singular : many);
}

std::string counts_table(const Model& model, const Counts& counts, bool fitted) {
  Table table({Table::Left, Table::Right, Table::Left, Table::Right});
  table.add({"vertices", number(counts.vertices), "   boundary points", number(counts.boundary_vertices)});
  table.add({"triangles", number(counts.triangles), "   boundary edges", number(counts.boundary_edges)});
  table.add({"patches", number(counts.patches), "   loops", number(counts.loops)});
  std::vector<std::string> more = {"shells", number(counts.shells)};
  if (fitted) more.insert(more.end(), {"   curve segments", number(counts.segments)});
  table.add(std::move(more));
  if (counts.open_chains > 0 || counts.instances != 1) {
    std::vector<std::string> row = {"instances", number(counts.instances)};
    if (counts.open_chains > 0) row.insert(row.end(), {"   open chains", number(counts.open_chains)});
    table.add(std::move(row));
  }
  return fmt::format("{}\n\n{}", model.name.empty() ? "model" : printable(model.name), table.text());
}

std::string loop_lengths(const PatchBoundary& patch) {
  std::string out;
  for (std::size_t l = 0; l < std::min(patch.loops.size(), kMostLoops); ++l) {
    const BoundaryLoop& loop = patch.loops[l];
    out += fmt::format("{}{}{}", l > 0 ? " " : "", loop.vertices.size(), loop.closed ? "" : "(open)");
  }
  return patch.loops.size() > kMostLoops ? out + " ..." : out;
}

// "2 lines, 2 arcs"
std::string kinds_text(const Counts& counts) {
  struct Kind {
    std::uint64_t count;
    std::string_view singular, many;
  };
  const std::array<Kind, 5> kinds = {{{counts.lines, "line", "lines"},
                                      {counts.arcs, "arc", "arcs"},
                                      {counts.circles, "circle", "circles"},
                                      {counts.ellipses, "ellipse", "ellipses"},
                                      {counts.splines, "spline", "splines"}}};
  std::string out;
  for (const auto& [count, singular, many] : kinds) {
    if (count > 0) out += (out.empty() ? "" : ", ") + plural(count, singular, many);
  }
  return out;
}

std::string patch_table(const Model& model, std::span<const ShellBoundary> boundaries,
                        std::span<const Contour> contours) {
  Table table(
      {Table::Left, Table::Right, Table::Right, Table::Right, Table::Right, Table::Left, Table::Left});
  table.add({"shell", "patch", "triangles", "edges", "loops", "vertices per loop",
             contours.empty() ? "" : "curves"});
  auto contour = contours.begin();
  for (std::size_t s = 0; s < boundaries.size(); ++s) {
    const Shell& shell = model.shells[s];
    for (std::size_t p = 0; p < boundaries[s].patches.size(); ++p) {
      const PatchBoundary& patch = boundaries[s].patches[p];
      Counts kinds;
      for (; contour != contours.end() && contour->shell == s && contour->patch == p; ++contour)
        count_kinds(*contour, kinds);
      table.add({printable(shell.id, 24), number(p + 1), number(shell.patches[p].triangle_count),
                 number(patch.edges.size()), number(patch.loops.size()), loop_lengths(patch),
                 kinds_text(kinds)});
    }
  }
  return table.text();
}

std::string loop_distribution(std::span<const ShellBoundary> boundaries) {
  std::map<std::size_t, std::uint64_t> patches_with;
  for (const ShellBoundary& boundary : boundaries) {
    for (const PatchBoundary& patch : boundary.patches) ++patches_with[patch.loops.size()];
  }
  Table table({Table::Right, Table::Right});
  table.add({"loops per patch", "patches"});
  for (const auto& [loops, patches] : patches_with) table.add({number(loops), number(patches)});
  return table.text();
}

// What a reader of the short form would not want to miss.
std::string findings(const Model& model, std::span<const ShellBoundary> boundaries) {
  std::string out;
  std::size_t count = 0;
  for (std::size_t s = 0; s < boundaries.size(); ++s) {
    for (std::size_t p = 0; p < boundaries[s].patches.size(); ++p) {
      const PatchBoundary& patch = boundaries[s].patches[p];
      const auto open = std::ranges::count(patch.loops, false, &BoundaryLoop::closed);
      if ((open == 0 && patch.nonmanifold_edges == 0) || ++count > kMostFindings) continue;
      out += fmt::format("shell {} patch {}:", printable(model.shells[s].id, 24), p + 1);
      if (open > 0)
        out += fmt::format(" {}", plural(static_cast<std::uint64_t>(open), "open chain", "open chains"));
      if (patch.nonmanifold_edges > 0) {
        out +=
            fmt::format(" {} with three or more triangles", plural(patch.nonmanifold_edges, "edge", "edges"));
      }
      out += '\n';
    }
  }
  if (count > kMostFindings) out += fmt::format("and {} more such patches\n", count - kMostFindings);
  return out;
}

std::string stage_table(std::span<const StageTime> timings) {
  Table table({Table::Left, Table::Right, Table::Right, Table::Right});
  table.add({"stage", "wall ms", "cpu ms", "items"});
  double wall = 0, cpu = 0;
  for (const StageTime& time : timings) {
    wall += time.wall_ms;
    cpu += time.cpu_ms;
    table.add({time.stage, fmt::format("{:.2f}", time.wall_ms), fmt::format("{:.2f}", time.cpu_ms),
               number(time.items)});
  }
  table.add({"total", fmt::format("{:.2f}", wall), fmt::format("{:.2f}", cpu)});
  return table.text();
}

std::string simplification_line(std::span<const Simplification> simplifications) {
  std::uint64_t before = 0, after = 0;
  double error = 0;
  for (const Simplification& s : simplifications) {
    before += s.triangles_before;
    after += s.triangles_after;
    error = std::max(error, s.error);
  }
  return fmt::format("simplified from {} to {}, at most {:.4g} apart\n",
                     plural(before, "triangle", "triangles"), after, error);
}

}  // namespace

std::string summary(const Model& model, std::span<const ShellBoundary> boundaries,
                    std::span<const Contour> contours, std::span<const StageTime> timings,
                    std::span<const Simplification> simplifications) {
  const Counts counts = counts_of(model, boundaries, contours);
  std::string out = counts_table(model, counts, !contours.empty());
  if (!boundaries.empty() && counts.patches > 0) {
    const bool brief = counts.patches > kMostPatches;
    out +=
        fmt::format("\n{}", brief ? loop_distribution(boundaries) : patch_table(model, boundaries, contours));
    const std::string found = brief ? findings(model, boundaries) : std::string();
    if (!found.empty()) out += fmt::format("\n{}", found);
    if (const std::string text = kinds_text(counts); !text.empty())
      out += fmt::format("\ncurves: {}\n", text);
  }
  if (!simplifications.empty()) out += fmt::format("\n{}", simplification_line(simplifications));
  if (!timings.empty()) out += fmt::format("\n{}", stage_table(timings));
  return out;
}

}  // namespace meshcontour

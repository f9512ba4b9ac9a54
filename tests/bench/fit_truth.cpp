// Contours of CAD models against their true edges: bench_fit_truth (MODEL TRUTH.json)...
//
// For each model: the share of true lines, arcs and circles (from four chords, and shorter) that were
// recovered, the primitives that stand for something else, and the edges whose contour is farther from the
// true curve than chords between the mesh vertices plus the tolerance. VERBOSE=1 lists each miss and its
// cause.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "meshcontour/fit.hpp"
#include "meshcontour/read.hpp"

using namespace meshcontour;
using Json = nlohmann::json;

namespace {

constexpr double kDefaultTolerance = 1e-4;

struct TrueEdge {
  std::string type;
  std::vector<Index> nodes;
  std::vector<Point> samples;
  double radius = 0, chord_error = 0;
};

// A segment of a contour and the loop vertices along it.
struct Span {
  const Segment* segment;
  std::vector<Index> vertices;
};

struct Tally {
  std::map<std::string, int> counts;
  std::map<std::string, int> causes;
  double worst_share = 0;  // largest distance to the true edge / (chord error + tolerance)
};

std::vector<TrueEdge> edges_of(const Json& shell) {
  std::vector<TrueEdge> edges;
  for (const Json& e : shell["edges"]) {
    TrueEdge& edge = edges.emplace_back();
    edge.type = e["type"];
    if (e.contains("nodes") && !e["nodes"].is_null()) edge.nodes = e["nodes"].get<std::vector<Index>>();
    if (e.contains("samples") && !e["samples"].is_null()) {
      for (const Json& s : e["samples"]) edge.samples.emplace_back(s[0], s[1], s[2]);
    }
    if (e.contains("radius")) edge.radius = e["radius"];
    if (e.contains("chord_err") && !e["chord_err"].is_null()) edge.chord_error = e["chord_err"];
  }
  return edges;
}

double distance_to_carrier(const Curve& curve, const Point& p) {
  if (const auto* line = std::get_if<LineSegment>(&curve)) {
    const Vector along = (line->end - line->start).normalized(), v = p - line->start;
    return (v - v.dot(along) * along).norm();
  }
  if (const auto* arc = std::get_if<CircularArc>(&curve)) {
    const Vector v = p - arc->center;
    const double height = v.dot(arc->axis);
    return std::hypot((v - height * arc->axis).norm() - arc->radius, height);
  }
  const auto& arc = std::get<EllipticalArc>(curve);
  const double a = arc.major.norm(), b = a * arc.ratio;
  const Vector x = arc.major / a, y = arc.axis.cross(x), v = p - arc.center;
  double t = std::atan2(v.dot(y) / b, v.dot(x) / a);
  for (int i = 0; i < 20; ++i) {
    const double gx = v.dot(x) - a * std::cos(t), gy = v.dot(y) - b * std::sin(t);
    const double slope = -gx * a * std::sin(t) + gy * b * std::cos(t);
    t += slope / (a * a * std::sin(t) * std::sin(t) + b * b * std::cos(t) * std::cos(t) +
                  gx * a * std::cos(t) + gy * b * std::sin(t));
  }
  return (v - a * std::cos(t) * x - b * std::sin(t) * y).norm();
}

double largest_distance(const Curve& curve, const std::vector<Point>& points) {
  double worst = 0;
  for (const Point& p : points) worst = std::max(worst, distance_to_carrier(curve, p));
  return worst;
}

// The curve as many short chords.
std::vector<Point> dense(const Curve& curve, std::size_t chords) {
  std::vector<Point> points;
  const std::size_t steps = std::holds_alternative<LineSegment>(curve) ? 1 : 24 * chords;
  for (std::size_t i = 0; i <= steps; ++i) {
    points.push_back(evaluate(curve, static_cast<double>(i) / static_cast<double>(steps)));
  }
  return points;
}

double distance_to_polyline(const Point& p, const std::vector<Point>& line) {
  double best = 1e300;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vector chord = line[i + 1] - line[i], v = p - line[i];
    const double t = std::clamp(v.dot(chord) / std::max(chord.squaredNorm(), 1e-300), 0.0, 1.0);
    best = std::min(best, (v - t * chord).norm());
  }
  return best;
}

bool holds(const Span& span, const std::vector<Index>& nodes) {
  const std::set<Index> inside(span.vertices.begin(), span.vertices.end());
  return std::all_of(nodes.begin(), nodes.end(), [&](Index v) { return inside.count(v) > 0; });
}

std::set<std::pair<Index, Index>> chords_of(const std::vector<Index>& vertices) {
  std::set<std::pair<Index, Index>> chords;
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    chords.insert({std::min(vertices[i], vertices[i + 1]), std::max(vertices[i], vertices[i + 1])});
  }
  return chords;
}

const char* name_of(const Curve& curve) {
  constexpr const char* names[] = {"line", "arc", "ellipse", "spline"};
  return names[curve.index()];
}

// What the loop has in place of the edge.
std::string cause_of(const TrueEdge& edge, const std::vector<Span>& spans, double diagonal) {
  const auto chords = chords_of(edge.nodes);
  std::map<std::string, int> parts;
  std::string detail;
  for (const Span& span : spans) {
    const auto own = chords_of(span.vertices);
    std::size_t common = 0;
    for (const auto& chord : own) common += chords.count(chord);
    if (common == 0) continue;
    ++parts[name_of(span.segment->curve)];
    if (common == chords.size() && span.segment->curve.index() != 3) {
      detail = fmt::format(" off {:.0e}", largest_distance(span.segment->curve, edge.samples) / diagonal);
      if (const auto* arc = std::get_if<CircularArc>(&span.segment->curve); arc && edge.radius > 0) {
        detail += fmt::format(", radius {:.0e}", std::abs(arc->radius / edge.radius - 1));
      }
    }
  }
  std::string text;
  for (const auto& [name, count] : parts)
    text += fmt::format("{}{} {}", text.empty() ? "" : " + ", count, name);
  return text + detail;
}

bool recovers(const Span& span, const TrueEdge& edge, const std::string& kind, double diagonal) {
  const Curve& curve = span.segment->curve;
  if (kind == "line" ? !std::holds_alternative<LineSegment>(curve)
                     : !std::holds_alternative<CircularArc>(curve)) {
    return false;
  }
  if (!holds(span, edge.nodes) || largest_distance(curve, edge.samples) > 1e-4 * diagonal) return false;
  if (kind == "line") return true;
  const double radius = std::get<CircularArc>(curve).radius;
  return std::abs(radius - edge.radius) <= 1e-3 * edge.radius + 1e-6 * diagonal;
}

bool is_false(const Span& span, const std::vector<const TrueEdge*>& edges, double diagonal) {
  const auto inside = chords_of(span.vertices);
  const bool line = std::holds_alternative<LineSegment>(span.segment->curve);
  for (const TrueEdge* edge : edges) {
    const auto chords = chords_of(edge->nodes);
    std::size_t common = 0;
    for (const auto& chord : chords) common += inside.count(chord);
    if (common == 0) continue;
    if (common == chords.size()) {
      if (largest_distance(span.segment->curve, edge->samples) > 2e-4 * diagonal) return true;
    } else if (edge->type != "line" || !line) {
      return true;
    }
  }
  return false;
}

// Distance of the true curve to the contour along it, over what chords and tolerance allow.
double excess(const TrueEdge& edge, const std::vector<Point>& points, const std::vector<Span>& spans,
              double tolerance) {
  std::vector<Point> nodes;
  for (const Index v : edge.nodes) nodes.push_back(points[v]);
  const auto chords = chords_of(edge.nodes);
  std::vector<std::vector<Point>> lines;
  for (const Span& span : spans) {
    const auto own = chords_of(span.vertices);
    if (std::any_of(own.begin(), own.end(), [&](const auto& c) { return chords.count(c) > 0; })) {
      lines.push_back(dense(span.segment->curve, own.size()));
    }
  }
  double worst = 0, allowed = edge.chord_error;
  for (const Point& p : edge.samples) {
    double best = 1e300;
    for (const auto& line : lines) best = std::min(best, distance_to_polyline(p, line));
    if (best < 1e299) worst = std::max(worst, best);
    allowed = std::max(allowed, distance_to_polyline(p, nodes));
  }
  return worst / (allowed + tolerance);
}

std::vector<Span> spans_of(const BoundaryLoop& loop, const Contour& contour) {
  std::vector<Span> spans;
  const std::size_t n = loop.vertices.size();
  for (const Segment& segment : contour.segments) {
    Span& span = spans.emplace_back(Span{&segment, {}});
    const auto start =
        std::find(loop.vertices.begin(), loop.vertices.end(), segment.from) - loop.vertices.begin();
    std::size_t at = static_cast<std::size_t>(start);
    span.vertices.push_back(loop.vertices[at]);
    do {
      at = (at + 1) % n;
      span.vertices.push_back(loop.vertices[at]);
    } while (loop.vertices[at] != segment.to && span.vertices.size() <= n);
  }
  return spans;
}

void evaluate_face(const Json& face, const std::vector<TrueEdge>& edges, const std::vector<Point>& points,
                   const std::vector<Span>& spans, double diagonal, double tolerance,
                   const std::string& place, Tally& tally) {
  const bool verbose = std::getenv("VERBOSE") != nullptr;
  std::vector<const TrueEdge*> used;
  for (const Json& loop : face["loops"]) {
    for (const Json& use : loop) used.push_back(&edges[use[0].get<std::size_t>()]);
  }
  for (const TrueEdge* edge : used) {
    if (edge->nodes.size() < 2) continue;
    const double share = excess(*edge, points, spans, tolerance);
    tally.worst_share = std::max(tally.worst_share, share);
    ++tally.counts["edges"];
    if (share > 1) {
      ++tally.counts["too far"];
      if (verbose) {
        fmt::print("    too far {:.2f} {} edge {} {} chords {}: {}\n", share, place, edge - edges.data(),
                   edge->type, edge->nodes.size() - 1, cause_of(*edge, spans, diagonal));
      }
    }
    if (edge->type != "line" && edge->type != "circle") continue;
    const std::string kind = edge->type == "line" ? "line" : edge->nodes.size() > 4 ? "arc" : "short";
    ++tally.counts[kind];
    const bool found = std::any_of(spans.begin(), spans.end(),
                                   [&](const Span& span) { return recovers(span, *edge, kind, diagonal); });
    tally.counts[kind + " found"] += found;
    if (found) continue;
    const std::string cause = cause_of(*edge, spans, diagonal);
    ++tally.causes[kind + " as " + cause];
    if (verbose) fmt::print("    missed {} edge {} {}: {}\n", place, edge - edges.data(), kind, cause);
  }
  for (const Span& span : spans) {
    if (std::holds_alternative<BSplineCurve>(span.segment->curve)) {
      ++tally.counts["splines"];
      continue;
    }
    ++tally.counts["primitives"];
    if (!is_false(span, used, diagonal)) continue;
    ++tally.counts["false"];
    ++tally.causes[fmt::format("false {}", name_of(span.segment->curve))];
    if (verbose) {
      fmt::print("    false {} {} from {} to {}, {} chords\n", name_of(span.segment->curve), place,
                 span.segment->from, span.segment->to, span.vertices.size() - 1);
    }
  }
}

double share(Tally& tally, const std::string& kind) {
  return tally.counts[kind] == 0 ? 100 : 100.0 * tally.counts[kind + " found"] / tally.counts[kind];
}

void print(const std::string& name, Tally& tally, double seconds) {
  auto& c = tally.counts;
  fmt::print(
      "{:24} lines {:5} {:6.2f} %  arcs {:5} {:6.2f} %  short {:4} {:6.2f} %  false {:3} of {:5}  splines "
      "{:4}"
      "  too far {:3} of {:5} (worst {:.2f})  {:.3f} s\n",
      name, c["line"], share(tally, "line"), c["arc"], share(tally, "arc"), c["short"], share(tally, "short"),
      c["false"], c["primitives"], c["splines"], c["too far"], c["edges"], tally.worst_share, seconds);
}

std::string model_name(const std::string& path) {
  const std::string file = path.substr(path.find_last_of('/') + 1);
  return file.substr(0, file.find_last_of('.'));
}

void evaluate_model(const std::string& model_file, const std::string& truth_file, Tally& total) {
  const Json truth = Json::parse(std::ifstream(truth_file));
  const Model model = read_model(model_file);
  std::vector<Diagnostic> diagnostics;
  const std::vector<ShellBoundary> boundaries = extract_boundaries(model, {}, diagnostics);
  FitOptions options;
  options.method = FitMethod::Primitives;
  options.threads = 1;
  const auto start = std::chrono::steady_clock::now();
  const std::vector<Contour> contours = fit_contours(model, boundaries, options, diagnostics);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::map<std::string, std::size_t> shell_number;
  for (std::size_t s = 0; s < model.shells.size(); ++s) shell_number[model.shells[s].id] = s;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<const Contour*>> by_patch;
  for (const Contour& contour : contours) by_patch[{contour.shell, contour.patch}].push_back(&contour);
  Tally tally;
  for (const Json& shell : truth["shell_list"]) {
    const std::vector<TrueEdge> edges = edges_of(shell);
    const std::size_t s = shell_number.at(shell["id"]);
    for (const Json& face : shell["faces"]) {
      if (face["patch"].is_null() || face.value("ambiguous", false)) continue;
      const std::size_t p = face["patch"];
      std::vector<Span> spans;
      double diagonal = 1e300;
      for (const Contour* contour : by_patch[{s, p}]) {
        const BoundaryLoop& loop = boundaries[s].patches[p].loops[contour->loop];
        Box box;
        for (const Index v : loop.vertices) box.extend(model.shells[s].points[v]);
        diagonal = std::min(diagonal, box.diagonal().norm());
        for (Span& span : spans_of(loop, *contour)) spans.push_back(std::move(span));
      }
      evaluate_face(face, edges, model.shells[s].points, spans, truth["diag"], kDefaultTolerance * diagonal,
                    fmt::format("shell {} patch {}", model.shells[s].id, p + 1), tally);
    }
  }
  print(model_name(model_file), tally, seconds);
  for (const auto& [cause, count] : tally.causes) fmt::print("    {:4} {}\n", count, cause);
  for (const auto& [name, count] : tally.counts) total.counts[name] += count;
  for (const auto& [cause, count] : tally.causes) total.causes[cause] += count;
  total.worst_share = std::max(total.worst_share, tally.worst_share);
}

}  // namespace

int main(int count, char** arguments) {
  Tally total;
  for (int i = 1; i + 1 < count; i += 2) evaluate_model(arguments[i], arguments[i + 1], total);
  print("ALL", total, 0);
}

#include "read/webxml_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <utility>

#include "base/line_counter.hpp"
#include "meshcontour/parallel.hpp"
#include "read/webxml_body.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::size_t kThreadedBytes = 1 << 18;  // starting threads takes longer than to scan so much

// A piece of a body on its way through the scan.
struct Job {
  std::size_t body, piece;
  bool taken = false;
  Index highest = 0;
};

// What is known of a body besides its outline.
struct BodyState {
  std::size_t shell = 0;           // for <verts> and <facets>
  std::size_t first_triangle = 0;  // of its shell, for <facets>
  std::size_t line = 0;            // where it begins; for those that are parsed
  bool scanned = false;            // its content is in place
  Index highest = 0;               // index in <facets>
  std::vector<Point> points;       // of <verts> and <polyline>
  FacetData facets;                // of <facets> that were not scanned
  Findings findings;
  std::exception_ptr error;
};

class ContentReader {
 public:
  ContentReader(const TextSource& source, WebxmlFile& file, const ReadOptions& options)
      : source_(source),
        file_(file),
        options_(options),
        bodies_(file.outline.bodies),
        states_(bodies_.size()) {}

  // False if the ends of bodies were guessed wrong; then nothing is valid.
  bool run() {
    allocate();
    scan();
    if (file_.outline.guessed && !ends_are_right()) return false;
    parse_rest(BodyKind::Vertices);
    take_points();
    parse_rest(BodyKind::Polyline);
    check_indices();
    parse_rest(BodyKind::Facets);
    for (std::size_t s = 0; s < file_.shells.size(); ++s) splice(s);
    take_polylines();
    for (const BodyState& state : states_) file_.findings.merge(state.findings);
    return true;
  }

 private:
  std::size_t plain_items(std::size_t body) const {
    return bodies_[body].plain ? bodies_[body].outline.items : 0;
  }

  void allocate() {
    file_.shells.resize(file_.document.shells.size());
    check_limit();
    for (std::size_t s = 0; s < file_.shells.size(); ++s) allocate_shell(s);
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (bodies_[b].kind != BodyKind::Facets) states_[b].points.resize(plain_items(b));
    }
  }

  void check_limit() const {
    std::uint64_t triangles = 0;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (bodies_[b].kind == BodyKind::Facets)
        triangles += plain_items(b) + states_[b].facets.triangles.size();
    }
    if (triangles <= options_.max_triangles) return;
    throw Error(ErrorCode::OutOfMemory,
                fmt::format("{} triangles, the limit is {}", triangles, options_.max_triangles),
                Spot{file_.name, 0, 0, ""});
  }

  void allocate_shell(std::size_t s) {
    const WebxmlShell& element = file_.document.shells[s];
    std::size_t triangles = 0, normals = 0;
    if (element.vertices) states_[*element.vertices].shell = s;
    for (const WebxmlFacets& facets : element.facets) {
      if (!facets.body) continue;
      states_[*facets.body].shell = s;
      states_[*facets.body].first_triangle = triangles;
      triangles += plain_items(*facets.body);
      if (bodies_[*facets.body].plain) normals += bodies_[*facets.body].outline.normals;
    }
    file_.shells[s].triangles.resize(triangles);
    if (normals > 0) file_.shells[s].corner_normals.resize(3 * triangles);
  }

  void scan() {
    std::vector<Job> jobs;
    std::size_t bytes = 0;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      states_[b].scanned = bodies_[b].plain;
      const auto& pieces = bodies_[b].outline.pieces;
      for (std::size_t piece = 0; bodies_[b].plain && piece < pieces.size(); ++piece) {
        bytes += pieces[piece].end - pieces[piece].begin;
        jobs.push_back({b, piece});
      }
    }
    const std::size_t grain = bytes > kThreadedBytes ? 1 : std::max<std::size_t>(jobs.size(), 1);
    parallel_for(jobs.size(), grain, options_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t j = begin; j < end; ++j) scan(jobs[j]);
    });
    for (const Job& job : jobs) {
      BodyState& state = states_[job.body];
      state.scanned = state.scanned && job.taken;
      state.highest = std::max(state.highest, job.highest);
    }
  }

  void scan(Job& job) {
    const BodyPiece& piece = bodies_[job.body].outline.pieces[job.piece];
    std::string buffer = buffers_.take();
    job.taken = take_piece(job, piece, piece_text(source_, piece, buffer));
    buffers_.give_back(std::move(buffer));
  }

  bool take_piece(Job& job, const BodyPiece& piece, std::string_view text) {
    const BodyKind kind = bodies_[job.body].kind;
    BodyState& state = states_[job.body];
    if (kind != BodyKind::Facets) {
      return scan_points(text, kind, std::span(state.points).subspan(piece.first_item, piece.items));
    }
    Shell& shell = file_.shells[state.shell];
    const std::size_t first = state.first_triangle + piece.first_item;
    std::span<Vector> normals;
    if (!shell.corner_normals.empty()) {
      normals = std::span(shell.corner_normals).subspan(3 * first, 3 * piece.items);
    }
    return scan_facets(text, std::span(shell.triangles).subspan(first, piece.items), normals, job.highest);
  }

  // A body that was scanned holds no markup but its own: its end is right. The others are parsed to their
  // end.
  bool ends_are_right() const {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (!states_[b].scanned && !ends_as_outlined(source_, bodies_[b], file_.name)) return false;
    }
    return true;
  }

  // Bodies of one kind that the scan did not take. The first failure in file order is the one reported.
  void parse_rest(BodyKind kind) {
    std::vector<std::size_t> rest;
    LineCounter lines(source_);
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (bodies_[b].kind != kind || states_[b].scanned) continue;
      states_[b].line = lines.line(bodies_[b].begin);
      rest.push_back(b);
    }
    parallel_for(rest.size(), 1, options_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) parse(rest[k]);
    });
    for (const std::size_t b : rest) {
      if (!states_[b].error) continue;
      if (kind != BodyKind::Polyline) std::rethrow_exception(states_[b].error);
      leave_out_polyline(b);
    }
    if (kind == BodyKind::Facets) check_limit();
  }

  void parse(std::size_t b) {
    BodyState& state = states_[b];
    const WebxmlBody& body = bodies_[b];
    std::string buffer = buffers_.take();
    try {
      const std::string element = body.kind == BodyKind::Polyline
                                      ? "polyline"
                                      : element_text("shell", file_.document.shells[state.shell].id);
      const BodySource source{source_.view(body.begin, body.end, buffer), state.line, file_.name, element};
      if (body.kind == BodyKind::Facets) {
        state.facets = parse_facets(source, file_.shells[state.shell].points.size(), state.findings);
      } else {
        state.points = parse_points(source, body.kind, state.findings);
      }
    } catch (...) {
      state.error = std::current_exception();
    }
    buffers_.give_back(std::move(buffer));
  }

  // Annotations are no reason to refuse a model.
  void leave_out_polyline(std::size_t b) {
    states_[b].points.clear();
    try {
      std::rethrow_exception(states_[b].error);
    } catch (const Error& error) {
      states_[b].findings.warn("polyline", [&] {
        return std::pair("a polyline is left out: " + message_of(error), error.spot());
      });
    }
  }

  void take_points() {
    for (std::size_t s = 0; s < file_.shells.size(); ++s) {
      const auto body = file_.document.shells[s].vertices;
      if (body) file_.shells[s].points = std::move(states_[*body].points);
      if (file_.shells[s].points.size() > std::numeric_limits<Index>::max()) {
        throw Error(ErrorCode::OutOfMemory, "a shell of more than 2^32 points", Spot{file_.name, 0, 0, ""});
      }
    }
  }

  void check_indices() {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      BodyState& state = states_[b];
      if (bodies_[b].kind != BodyKind::Facets || !state.scanned || bodies_[b].outline.items == 0) continue;
      state.scanned = state.highest < file_.shells[state.shell].points.size();
    }
  }

  // Puts the triangles that were parsed between those that were scanned, and writes down the patches.
  void splice(std::size_t s) {
    const WebxmlShell& element = file_.document.shells[s];
    Shell& shell = file_.shells[s];
    shell.id = element.id;
    shell.color = element.color.value_or(Rgba{});
    const auto parsed = [&](const WebxmlFacets& facets) {
      return facets.body && !states_[*facets.body].scanned;
    };
    if (std::ranges::any_of(element.facets, parsed)) join(element, shell);
    std::size_t first = 0;
    for (const WebxmlFacets& facets : element.facets) {
      const std::size_t count = facets.body ? triangle_count(*facets.body) : 0;
      shell.patches.push_back({"", facets.color.value_or(shell.color), first, count});
      first += count;
    }
  }

  std::size_t triangle_count(std::size_t b) const {
    return states_[b].scanned ? bodies_[b].outline.items : states_[b].facets.triangles.size();
  }

  void join(const WebxmlShell& element, Shell& shell) {
    FacetData all;
    bool with_normals = false;
    for (const WebxmlFacets& facets : element.facets) {
      if (!facets.body) continue;
      const BodyState& state = states_[*facets.body];
      const std::size_t count = triangle_count(*facets.body);
      const auto from = state.scanned
                            ? std::span<const Triangle>(shell.triangles).subspan(state.first_triangle, count)
                            : std::span<const Triangle>(state.facets.triangles);
      auto normals = std::span<const Vector>(state.facets.normals);
      if (state.scanned && bodies_[*facets.body].outline.normals > 0) {
        normals = std::span<const Vector>(shell.corner_normals).subspan(3 * state.first_triangle, 3 * count);
      }
      with_normals = with_normals || !normals.empty();
      all.normals.resize(with_normals ? 3 * all.triangles.size() : 0, Vector::Zero());
      all.triangles.insert(all.triangles.end(), from.begin(), from.end());
      all.normals.insert(all.normals.end(), normals.begin(), normals.end());
    }
    all.normals.resize(with_normals ? 3 * all.triangles.size() : 0, Vector::Zero());
    shell.triangles = std::move(all.triangles);
    shell.corner_normals = std::move(all.normals);
  }

  void take_polylines() {
    for (const WebxmlAnnotation& annotation : file_.document.annotations) {
      std::vector<std::vector<Point>> lines;
      for (const std::size_t body : annotation.polylines) lines.push_back(std::move(states_[body].points));
      file_.polylines.push_back(std::move(lines));
    }
  }

  const TextSource& source_;
  BufferPool buffers_;
  WebxmlFile& file_;
  const ReadOptions& options_;
  const std::vector<WebxmlBody>& bodies_;
  std::vector<BodyState> states_;
};

WebxmlFile outlined(const TextSource& source, const std::string& name, bool careful) {
  Findings findings;
  WebxmlOutline outline = outline_webxml(source, name, careful, findings);
  WebxmlDocument document = read_document(outline, name, findings);
  return {name, std::move(outline), std::move(document), {}, {}, std::move(findings)};
}

}  // namespace

WebxmlFile read_webxml_content(TextSource& source, const std::string& name, const ReadOptions& options,
                               bool careful) {
  Findings padding;
  cut_padding(source, name, padding);
  if (!careful) {
    WebxmlFile file = outlined(source, name, false);
    if (ContentReader(source, file, options).run()) {
      file.findings.merge(padding);
      return file;
    }
  }
  WebxmlFile file = outlined(source, name, true);
  ContentReader(source, file, options).run();
  file.findings.merge(padding);
  return file;
}

}  // namespace meshcontour::detail

#include "read/webxml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "meshcontour/cleaning.hpp"
#include "meshcontour/parallel.hpp"
#include "read/encoding.hpp"
#include "read/webxml_assembly.hpp"

namespace meshcontour::detail {
namespace {

// Shells and annotations that are in files of their own.
class References {
 public:
  References(WebxmlFile& file, const ReadContext& context, bool careful)
      : file_(file), context_(context), careful_(careful), same_shell_(file.shells.size()) {
    std::iota(same_shell_.begin(), same_shell_.end(), std::size_t{0});
  }

  void read() {
    for (std::size_t s = 0; s < file_.shells.size(); ++s) {
      const WebxmlShell& shell = file_.document.shells[s];
      if (shell.href)
        add(*shell.href, shell.id, true, s, shell.vertices || !shell.facets.empty(), shell.digest_line);
    }
    for (std::size_t a = 0; a < file_.polylines.size(); ++a) {
      const WebxmlAnnotation& annotation = file_.document.annotations[a];
      if (annotation.href) {
        add(*annotation.href, annotation.id, false, a, !annotation.polylines.empty(), annotation.digest_line);
      }
    }
    const bool many = parts_.size() > 1;
    ReadOptions options = context_.options;
    if (many) options.threads = 1;
    parallel_for(parts_.size(), 1, context_.options.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) read(parts_[k], options);
    });
    for (Part& part : parts_) take(part);
  }

  /// The shell that stands for another one that names the same file; itself for all others.
  std::size_t same_shell(std::size_t shell) const { return same_shell_[shell]; }
  std::size_t missing() const { return missing_; }
  const std::string& first_missing() const { return first_missing_; }

 private:
  struct Part {
    std::string href, id;
    bool is_shell = true;
    std::size_t index = 0;  // of the shell or annotation
    std::optional<WebxmlFile> content;
    std::exception_ptr error;
  };

  void add(const std::string& href, const std::string& id, bool is_shell, std::size_t index, bool inline_too,
           int digest_line) {
    const auto spot = [&] {
      return Spot{file_.name, file_.outline.digest.line(digest_line), 0, element_name(is_shell, id)};
    };
    if (inline_too) {
      file_.findings.warn("inline and href",
                          [&] { return std::pair("content and href together: the content counts", spot()); });
      return;
    }
    if (context_.folder == nullptr) {
      throw Error(ErrorCode::BadData,
                  fmt::format("its file '{}' cannot be found: the model is not read from a file",
                              printable(href, 80)),
                  spot());
    }
    try {
      const std::optional<InputFile> found = context_.folder->open(href);
      if (!found) return report_missing(href, spot);
      const auto [known, is_new] = known_.try_emplace({found->identity(), is_shell}, index);
      if (is_new) parts_.push_back({href, id, is_shell, index, std::nullopt, nullptr});
      if (is_shell) same_shell_[index] = known->second;
    } catch (const Error& error) {
      throw Error(error.code(), message_of(error), spot());
    }
  }

  template <typename Place>
  void report_missing(const std::string& href, const Place& spot) {
    if (missing_++ == 0) first_missing_ = href;
    file_.findings.warn("missing file", [&] {
      return std::pair(fmt::format("its file '{}' does not exist: it is left out", printable(href, 80)),
                       spot());
    });
  }

  static std::string element_name(bool is_shell, const std::string& id) {
    return element_text(is_shell ? "shell" : "annotation", id);
  }

  void read(Part& part, const ReadOptions& options) const {
    try {
      std::optional<InputFile> input = context_.folder->open(part.href);
      if (!input)
        throw Error(ErrorCode::InputOutput, "vanished while its model was read", Spot{part.href, 0, 0, ""});
      part.content.emplace(read_part(*input, options));
      check(part);
    } catch (...) {
      part.error = std::current_exception();
    }
  }

  WebxmlFile read_part(InputFile& input, const ReadOptions& options) const {
    if (input.size() > 0 && !looks_like_utf16(input.head())) {
      TextSource source(input);
      return read_webxml_content(source, input.name(), options, careful_);
    }
    const FileBytes bytes = input.read();
    const std::string text =
        looks_like_utf16(bytes.view()) ? utf8_from_utf16(bytes.view()) : std::string(bytes.view());
    TextSource source(text);
    return read_webxml_content(source, input.name(), options, careful_);
  }

  static void check(Part& part) {
    WebxmlFile& content = *part.content;
    const std::string wanted = part.is_shell ? "shell" : "annotation";
    const Spot spot{content.name, 0, 0, ""};
    if (content.document.root_element != wanted) {
      throw Error(ErrorCode::BadData,
                  fmt::format("the document element is <{}>, not the <{}> that the model names",
                              content.document.root_element, wanted),
                  spot);
    }
    const bool further = part.is_shell ? content.document.shells[0].href.has_value()
                                       : content.document.annotations[0].href.has_value();
    if (further) throw Error(ErrorCode::BadData, "names a further file, which a part must not", spot);
    const std::string& id =
        part.is_shell ? content.document.shells[0].id : content.document.annotations[0].id;
    if (id == part.id) return;
    content.findings.warn("other id", [&] {
      return std::pair(fmt::format("has the id '{}', not '{}' as the model says", printable(id, 80),
                                   printable(part.id, 80)),
                       spot);
    });
  }

  void take(Part& part) {
    if (part.error) std::rethrow_exception(part.error);
    file_.findings.merge(part.content->findings);
    if (part.is_shell) {
      Shell& shell = file_.shells[part.index];
      shell = std::move(part.content->shells[0]);
      shell.id = part.id;
    } else {
      file_.polylines[part.index] = std::move(part.content->polylines[0]);
    }
    part.content.reset();
  }

  WebxmlFile& file_;
  const ReadContext& context_;
  bool careful_;
  std::vector<Part> parts_;
  std::vector<std::size_t> same_shell_;
  std::map<std::pair<std::pair<dev_t, ino_t>, bool>, std::size_t> known_;
  std::size_t missing_ = 0;
  std::string first_missing_;
};

// What a file gives when nothing says where its shells belong: all of them, as they are.
void place_as_they_are(const WebxmlGraph& graph, WebxmlFile& file, Model& model) {
  for (std::size_t s = 0; s < file.shells.size(); ++s) {
    model.instances.push_back({s, Eigen::Affine3d::Identity(), file.shells[s].id});
  }
  if (file.document.root_element == "annotation" && model.annotations.empty()) {
    for (const auto& points : file.polylines[0]) {
      if (points.size() > 1) model.annotations.push_back({file.document.annotations[0].id, points});
    }
  }
  if (file.document.root_element == "shell" || file.shells.empty()) return;
  const bool expected = graph.roots.empty();
  file.findings.add("not placed", [&] {
    return Diagnostic{expected ? Findings::Severity::Note : Findings::Severity::Warning,
                      "no shape places a shell: all are taken as they are",
                      {file.name, 0, 0, ""},
                      1};
  });
}

// Moves the shells into the model, without those that have no content of their own or share their id with a
// later one.
void take_shells(const WebxmlGraph& graph, WebxmlFile& file, const References& references, Model& model) {
  constexpr std::size_t kNone = ~std::size_t{0};
  std::vector<std::size_t> number(file.shells.size(), kNone);
  for (std::size_t s = 0; s < file.shells.size(); ++s) {
    const bool elsewhere =
        file.document.shells[s].href && file.shells[s].points.empty() && file.shells[s].patches.empty();
    if (elsewhere || graph.shadowed_shells[s]) continue;
    number[s] = model.shells.size();
    model.shells.push_back(std::move(file.shells[s]));
  }
  for (Instance& instance : model.instances) instance.shell = number[references.same_shell(instance.shell)];
  std::erase_if(model.instances, [](const Instance& instance) { return instance.shell == kNone; });
}

void finish_shells(WebxmlFile& file, Model& model, unsigned threads) {
  for (Shell& shell : model.shells) {
    const Spot spot{file.name, 0, 0, element_text("shell", shell.id)};
    std::vector<Diagnostic> found;
    drop_degenerate_and_duplicate_triangles(shell, found, threads);
    for (const Diagnostic& diagnostic : found) {
      file.findings.add(
          diagnostic.message,
          [&] {
            Diagnostic first = diagnostic;
            first.spot.file = file.name;
            return first;
          },
          diagnostic.count);
    }
    if (shell.triangles.empty()) {
      file.findings.warn("no triangles", [&] { return std::pair("a shell without triangles", spot); });
    } else if (const std::size_t unused = count_unused_points(shell); unused > 0) {
      file.findings.add(
          "unused",
          [&] {
            return Diagnostic{Findings::Severity::Note, "a vertex that no triangle uses", spot, 1};
          },
          unused);
    }
  }
}

[[noreturn]] void fail_empty(const WebxmlFile& file, const References& references) {
  const Spot spot{file.name, 0, 0, ""};
  if (references.missing() == 0)
    throw Error(ErrorCode::BadData, "nothing to draw: no shell and no annotation", spot);
  throw Error(ErrorCode::BadData,
              fmt::format("nothing to draw: {} of its files do not exist, the first is '{}'",
                          references.missing(), printable(references.first_missing(), 80)),
              spot);
}

Model read(TextSource& source, const ReadContext& context, bool careful) {
  WebxmlFile file = read_webxml_content(source, context.name, context.options, careful);
  const WebxmlGraph graph = resolve_references(file);
  check_limits(measure_assembly(graph, file), context.options, context.name);
  References references(file, context, careful);
  references.read();
  check_limits(measure_assembly(graph, file), context.options, context.name);
  Model model;
  model.name = graph.name;
  model.metres_per_unit = model_unit(graph, file);
  place_assembly(graph, file, model);
  if (model.instances.empty()) place_as_they_are(graph, file, model);
  take_shells(graph, file, references, model);
  finish_shells(file, model, context.options.threads);
  if (model.shells.empty() && model.annotations.empty()) fail_empty(file, references);
  model.diagnostics = file.findings.diagnostics();
  return model;
}

Model read(std::string_view bytes, const ReadContext& context, bool careful) {
  const std::string text = looks_like_utf16(bytes) ? utf8_from_utf16(bytes) : std::string();
  TextSource source(text.empty() ? bytes : text);
  return read(source, context, careful);
}

}  // namespace

Match sniff_webxml(std::string_view head, std::uint64_t) {
  if (looks_like_utf16(head)) return Match::Sure;
  if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
  head.remove_prefix(std::min(head.find_first_not_of(" \t\r\n"), head.size()));
  return head.starts_with('<') ? Match::Sure : Match::No;
}

Model read_webxml(std::string_view bytes, const ReadContext& context) {
  return read(bytes, context, false);
}

Model read_webxml_file(InputFile& file, const ReadContext& context) {
  if (looks_like_utf16(file.head())) return read(file.read().view(), context, false);
  TextSource source(file);
  return read(source, context, false);
}

Model read_webxml_carefully(std::string_view bytes, const ReadContext& context) {
  return read(bytes, context, true);
}

}  // namespace meshcontour::detail

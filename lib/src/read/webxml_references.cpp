#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>

#include "read/webxml_assembly.hpp"

namespace meshcontour::detail {
namespace {

enum class Element { Product, Shape, Shell, Annotation };

constexpr std::array<std::string_view, 4> kElementNames = {"product", "shape", "shell", "annotation"};

struct Entry {
  std::string_view id;
  Element element;
  std::size_t index;
};

class Resolver {
 public:
  explicit Resolver(WebxmlFile& file) : file_(file), document_(file.document) {}

  WebxmlGraph run() {
    collect();
    for (const WebxmlShape& shape : document_.shapes) graph_.shapes.push_back(resolve(shape));
    find_roots();
    order_shapes();
    report_unreferenced();
    return std::move(graph_);
  }

 private:
  // All ids are in one name space; in a sorted list no choice of ids makes the search slow.
  void collect() {
    add(document_.products, Element::Product);
    add(document_.shapes, Element::Shape);
    add(document_.shells, Element::Shell);
    add(document_.annotations, Element::Annotation);
    std::ranges::stable_sort(entries_, {}, &Entry::id);
    graph_.shadowed_shells.resize(document_.shells.size());
    for (std::size_t i = 1; i < entries_.size(); ++i) {
      if (entries_[i].id != entries_[i - 1].id) continue;
      if (entries_[i - 1].element == Element::Shell) graph_.shadowed_shells[entries_[i - 1].index] = true;
      file_.findings.warn("same id", [&] {
        return std::pair(fmt::format("id '{}' is given to more than one element: the last counts",
                                     printable(entries_[i].id, 80)),
                         Spot{file_.name, 0, 0, ""});
      });
    }
  }

  template <typename Elements>
  void add(const Elements& elements, Element element) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (!elements[i].id.empty()) entries_.push_back({elements[i].id, element, i});
    }
  }

  // The element that an id names, if it is of the kind asked for; a warning otherwise.
  std::optional<std::size_t> find(std::string_view id, Element wanted, int digest_line) {
    const auto after = std::ranges::upper_bound(entries_, id, {}, &Entry::id);
    const bool found = after != entries_.begin() && std::prev(after)->id == id;
    if (found && std::prev(after)->element == wanted) return std::prev(after)->index;
    const std::string_view name = kElementNames[static_cast<std::size_t>(wanted)];
    file_.findings.warn(fmt::format("no {}", name), [&] {
      return std::pair(fmt::format("'{}' names no {} and is left out", printable(id, 80), name),
                       Spot{file_.name, file_.outline.digest.line(digest_line), 0, ""});
    });
    return std::nullopt;
  }

  std::vector<std::size_t> find_all(const WebxmlReferences& references, Element wanted) {
    std::vector<std::size_t> found;
    for (const std::string& id : references.ids) {
      if (const auto index = find(id, wanted, references.digest_line)) found.push_back(*index);
    }
    return found;
  }

  WebxmlGraph::Shape resolve(const WebxmlShape& element) {
    WebxmlGraph::Shape shape{
        find_all(element.shells, Element::Shell), find_all(element.annotations, Element::Annotation), {}};
    for (const WebxmlChild& child : element.children) {
      const auto index = find(child.shape, Element::Shape, child.digest_line);
      if (index && child.placement) shape.children.push_back({*index, *child.placement});
    }
    return shape;
  }

  void find_roots() {
    if (document_.roots) {
      for (const std::string& id : document_.roots->ids) {
        if (const auto product = find(id, Element::Product, document_.roots->digest_line)) add_root(*product);
      }
    }
    if (!graph_.roots.empty() || document_.products.empty()) {
      if (graph_.roots.empty()) add_top_shapes();
      return;
    }
    file_.findings.warn("root", [&] {
      return std::pair("no root product: the products that no other names take its place",
                       Spot{file_.name, 0, 0, document_.root_element});
    });
    add_top_products();
    if (graph_.roots.empty()) add_top_shapes();
  }

  void add_root(std::size_t product) {
    const WebxmlProduct& element = document_.products[product];
    if (graph_.name.empty()) graph_.name = element.name;
    for (const std::size_t shape : find_all(element.shapes, Element::Shape))
      graph_.roots.push_back({element.id, shape});
  }

  void add_top_products() {
    std::vector<bool> named(document_.products.size());
    for (const WebxmlProduct& product : document_.products) {
      for (const std::size_t child : find_all(product.children, Element::Product)) named[child] = true;
    }
    for (std::size_t p = 0; p < named.size(); ++p) {
      if (!named[p]) add_root(p);
    }
  }

  void add_top_shapes() {
    std::vector<bool> named(graph_.shapes.size());
    for (const WebxmlGraph::Shape& shape : graph_.shapes) {
      for (const WebxmlGraph::Child& child : shape.children) named[child.shape] = true;
    }
    for (std::size_t s = 0; s < named.size(); ++s) {
      if (!named[s]) graph_.roots.push_back({"", s});
    }
    if (graph_.roots.empty() && !named.empty()) graph_.roots.push_back({"", 0});  // each is named: a cycle
  }

  // Depth first without recursion, children before parents; a shape met while it is open closes a cycle.
  void order_shapes() {
    enum class State : unsigned char { New, Open, Done };
    std::vector<State> states(graph_.shapes.size(), State::New);
    std::vector<std::pair<std::size_t, std::size_t>> path;  // shape, children seen
    for (const WebxmlGraph::Root& root : graph_.roots) {
      if (states[root.shape] == State::New) path.push_back({root.shape, 0});
      while (!path.empty()) {
        const std::size_t shape = path.back().first;
        const auto& children = graph_.shapes[shape].children;
        states[shape] = State::Open;
        if (path.back().second == children.size()) {
          states[shape] = State::Done;
          graph_.used_shapes.push_back(shape);
          path.pop_back();
          continue;
        }
        const std::size_t child = children[path.back().second++].shape;
        if (states[child] == State::Open) fail_cycle(path, child);
        if (states[child] == State::New) path.push_back({child, 0});
      }
    }
  }

  [[noreturn]] void fail_cycle(const std::vector<std::pair<std::size_t, std::size_t>>& path,
                               std::size_t shape) {
    const auto start = std::ranges::find(path, shape, &std::pair<std::size_t, std::size_t>::first);
    std::string cycle;
    constexpr std::ptrdiff_t kShown = 8;
    for (auto step = start; step != path.end() && step - start < kShown; ++step) {
      cycle += printable(document_.shapes[step->first].id, 40) + " > ";
    }
    if (path.end() - start > kShown) cycle += "... > ";
    cycle += printable(document_.shapes[shape].id, 40);
    const std::size_t line = file_.outline.digest.line(document_.shapes[shape].digest_line);
    throw Error(ErrorCode::BadData, "shapes contain one another: " + cycle,
                Spot{file_.name, line, 0, "shape"});
  }

  void report_unreferenced() {
    std::vector<bool> used(document_.shells.size());
    for (const std::size_t s : graph_.used_shapes) {
      for (const std::size_t shell : graph_.shapes[s].shells) used[shell] = true;
    }
    if (graph_.roots.empty()) return;
    for (std::size_t s = 0; s < used.size(); ++s) {
      if (used[s] || graph_.shadowed_shells[s]) continue;
      file_.findings.note("unreferenced", [&] {
        return std::pair("a shell that is placed nowhere",
                         Spot{file_.name, file_.outline.digest.line(document_.shells[s].digest_line), 0,
                              element_text("shell", document_.shells[s].id)});
      });
    }
  }

  WebxmlFile& file_;
  const WebxmlDocument& document_;
  std::vector<Entry> entries_;
  WebxmlGraph graph_;
};

}  // namespace

WebxmlGraph resolve_references(WebxmlFile& file) {
  return Resolver(file).run();
}

}  // namespace meshcontour::detail

#include "read/webxml_assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/text_cursor.hpp"
#include "meshcontour/units.hpp"
#include "read/xml_words.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t kMostVisits = 32;                    // an instance; a path may be long
constexpr std::uint64_t kMostAnnotationPoints = 20'000'000;  // half a gigabyte
constexpr std::size_t kShownEnds = 16;                       // ids of a long path at either end

void add(std::uint64_t& sum, std::uint64_t value) {
  sum = value > kMost - sum ? kMost : sum + value;
}

void add(AssemblySize& sum, const AssemblySize& part) {
  add(sum.instances, part.instances);
  add(sum.triangles, part.triangles);
  add(sum.annotation_points, part.annotation_points);
  add(sum.visits, part.visits);
}

bool is_empty(const AssemblySize& size) {
  return size.instances == 0 && size.annotation_points == 0;
}

// Sizes of all shapes in use; children come before their parents.
std::vector<AssemblySize> measure_shapes(const WebxmlGraph& graph, const WebxmlFile& file) {
  std::vector<AssemblySize> sizes(graph.shapes.size());
  for (const std::size_t s : graph.used_shapes) {
    AssemblySize& size = sizes[s];
    size.visits = 1;
    size.instances = graph.shapes[s].shells.size();
    for (const std::size_t shell : graph.shapes[s].shells)
      add(size.triangles, file.shells[shell].triangles.size());
    for (const std::size_t annotation : graph.shapes[s].annotations) {
      for (const auto& line : file.polylines[annotation]) add(size.annotation_points, line.size());
    }
    for (const WebxmlGraph::Child& child : graph.shapes[s].children) {
      if (!is_empty(sizes[child.shape])) add(size, sizes[child.shape]);
    }
  }
  return sizes;
}

class Placer {
 public:
  Placer(const WebxmlGraph& graph, WebxmlFile& file, Model& model)
      : graph_(graph), file_(file), model_(model), sizes_(measure_shapes(graph, file)) {}

  void run() {
    std::uint64_t instances = 0;
    for (const WebxmlGraph::Root& root : graph_.roots) add(instances, sizes_[root.shape].instances);
    model_.instances.reserve(instances);
    for (const WebxmlGraph::Root& root : graph_.roots) {
      enter(root.shape, Eigen::Affine3d::Identity(), root.path);
      while (!path_.empty()) step(root.path);
    }
  }

 private:
  struct Level {
    std::size_t shape;
    std::size_t next_child;
    Eigen::Affine3d placement;
  };

  void step(const std::string& product) {
    Level& level = path_.back();
    const auto& children = graph_.shapes[level.shape].children;
    if (level.next_child == children.size()) {
      path_.pop_back();
      return;
    }
    const WebxmlGraph::Child& child = children[level.next_child++];
    if (is_empty(sizes_[child.shape])) return;
    const Eigen::Affine3d placement(level.placement.matrix() * child.placement.matrix());
    if (placement.matrix().cwiseAbs().maxCoeff() > kUsualCoordinate) {
      file_.findings.warn("far placement", [&] {
        return std::pair("placements that together lead beyond 1e15 are left out",
                         Spot{file_.name, 0, 0, path(product)});
      });
      return;
    }
    enter(child.shape, placement, product);
  }

  void enter(std::size_t shape, const Eigen::Affine3d& placement, const std::string& product) {
    path_.push_back({shape, 0, placement});
    for (const std::size_t shell : graph_.shapes[shape].shells) {
      model_.instances.push_back({shell, placement, path(product)});
    }
    for (const std::size_t annotation : graph_.shapes[shape].annotations) {
      for (const auto& points : file_.polylines[annotation]) {
        if (points.size() < 2) continue;  // construction geometry has such
        Polyline line{file_.document.annotations[annotation].id, points};
        for (Point& p : line.points) p = Point(placement * p);
        model_.annotations.push_back(std::move(line));
      }
    }
  }

  // Product and shape ids; of a very long path only its ends, or paths would take more memory than the model.
  std::string path(const std::string& product) const {
    std::string text = product;
    for (std::size_t k = 0; k < path_.size(); ++k) {
      if (k == kShownEnds && path_.size() > 2 * kShownEnds) {
        text += "/...";
        k = path_.size() - kShownEnds;
      }
      if (!text.empty()) text += '/';
      text += file_.document.shapes[path_[k].shape].id;
    }
    return text;
  }

  const WebxmlGraph& graph_;
  WebxmlFile& file_;
  Model& model_;
  std::vector<AssemblySize> sizes_;
  std::vector<Level> path_;
};

// The factor of a unit attribute, e.g. "mm 0.001000". Six decimals only: small units print as zero, so that
// known names count more.
std::optional<double> unit_metres(std::string_view unit) {
  const auto words = xml_words(unit);
  if (words.empty()) return std::nullopt;
  if (const auto known = metres_of(words[0])) return known;
  const auto factor = words.size() > 1 ? parse_number(words[1]) : std::nullopt;
  return factor && *factor > 0 ? factor : std::nullopt;
}

}  // namespace

AssemblySize measure_assembly(const WebxmlGraph& graph, const WebxmlFile& file) {
  const std::vector<AssemblySize> sizes = measure_shapes(graph, file);
  AssemblySize total;
  for (const WebxmlGraph::Root& root : graph.roots) add(total, sizes[root.shape]);
  return total;
}

void check_limits(const AssemblySize& size, const ReadOptions& options, const std::string& file) {
  const auto check = [&](std::uint64_t count, std::uint64_t limit, std::string_view what) {
    if (count <= limit) return;
    const std::string number = count == kMost ? "more than 2^64" : fmt::format("{}", count);
    throw Error(ErrorCode::OutOfMemory,
                fmt::format("the assembly has {} {}, the limit is {}", number, what, limit),
                Spot{file, 0, 0, ""});
  };
  check(size.instances, options.max_instances, "instances");
  check(size.triangles, options.max_triangles, "triangles over all instances");
  check(size.annotation_points, kMostAnnotationPoints, "annotation points over all instances");
  const std::uint64_t visits =
      options.max_instances > kMost / kMostVisits ? kMost : options.max_instances * kMostVisits;
  check(size.visits, visits, "shapes on the paths to its instances");
}

void place_assembly(const WebxmlGraph& graph, WebxmlFile& file, Model& model) {
  Placer(graph, file, model).run();
}

double model_unit(const WebxmlGraph& graph, WebxmlFile& file) {
  std::vector<std::size_t> order;  // the roots' own units come first
  for (const WebxmlGraph::Root& root : graph.roots) order.push_back(root.shape);
  order.insert(order.end(), graph.used_shapes.begin(), graph.used_shapes.end());
  double unit = 0;
  std::string_view first;
  for (const std::size_t s : order) {
    const WebxmlShape& shape = file.document.shapes[s];
    if (shape.unit.empty()) continue;
    const auto metres = unit_metres(shape.unit);
    const auto spot = [&] {
      return Spot{file.name, file.outline.digest.line(shape.digest_line), 0, element_text("shape", shape.id)};
    };
    if (!metres) {
      file.findings.warn("unit", [&] {
        return std::pair(fmt::format("unit '{}' is not known", printable(shape.unit, 40)), spot());
      });
    } else if (unit == 0) {
      unit = *metres;
      first = shape.unit;
    } else if (std::abs(*metres - unit) > 1e-9 * unit) {
      file.findings.warn("mixed units", [&] {
        return std::pair(fmt::format("unit '{}' beside '{}': nothing is converted", printable(shape.unit, 40),
                                     printable(first, 40)),
                         spot());
      });
    }
  }
  return unit;
}

}  // namespace meshcontour::detail

#include "survey.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "support/paths.hpp"

namespace sweeps {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::size_t> parent_;
};

struct Component {
  std::vector<Point> points;
  double volume = 0;
  bool closed = true;
};

double six_volumes(const Shell& shell, const Triangle& t) {
  return shell.points[t[0]].dot(shell.points[t[1]].cross(shell.points[t[2]]));
}

double least_distance(Component& component) {
  Box box;
  for (const Point& p : component.points) box.extend(p);
  const double diagonal = box.diagonal().norm(), window = 1e-6 * diagonal;
  auto& points = component.points;
  std::ranges::sort(points, {}, [](const Point& p) { return std::tuple(p.x(), p.y(), p.z()); });
  double least = diagonal;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size() && points[j].x() - points[i].x() < window; ++j) {
      least = std::min(least, (points[j] - points[i]).norm());
    }
  }
  return least / diagonal;
}

void survey_edges(const Shell& shell, Survey& result, Groups& groups, std::vector<bool>& open) {
  std::map<std::pair<Index, Index>, std::pair<int, int>> edges;  // triangles along, against
  for (const Triangle& t : shell.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      auto& [along, against] = edges[std::minmax(a, b)];
      ++(a < b ? along : against);
      groups.join(a, b);
    }
  }
  result.edges = edges.size();
  Groups rims(shell.points.size());
  std::set<std::size_t> rim_vertices, loops;
  for (const auto& [edge, count] : edges) {
    if (count.first > 1 || count.second > 1) ++result.bad_edges;
    if (count.first + count.second != 1) continue;
    rims.join(edge.first, edge.second);
    rim_vertices.insert({edge.first, edge.second});
    open[edge.first] = true;
  }
  for (const std::size_t v : rim_vertices) loops.insert(rims.find(v));
  result.boundary_loops = loops.size();
}

void survey_faces(const Shell& shell, Survey& result) {
  const double size = bounding_box(shell).diagonal().norm();
  result.least_face = kInfinity;
  for (std::size_t i = 0; i < shell.triangles.size(); ++i) {
    const auto& [a, b, c] = shell.triangles[i];
    const Vector doubled = (shell.points[b] - shell.points[a]).cross(shell.points[c] - shell.points[a]);
    result.area += doubled.norm() / 2;
    result.volume += six_volumes(shell, shell.triangles[i]) / 6;
    result.least_face = std::min(result.least_face, doubled.norm() / 2 / (size * size));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector& normal = shell.corner_normals.at(3 * i + k);
      const bool agrees = std::abs(normal.norm() - 1) < 1e-12 && normal.dot(doubled) > 0;
      result.disagreeing += agrees ? 0 : 1;
    }
  }
}

}  // namespace

long Survey::euler() const {
  return static_cast<long>(vertices) - static_cast<long>(edges) + static_cast<long>(faces);
}

Survey survey(const Shell& shell) {
  Survey result;
  result.vertices = shell.points.size();
  result.faces = shell.triangles.size();
  Groups groups(shell.points.size());
  std::vector<bool> open(shell.points.size(), false), used(shell.points.size(), false);
  survey_edges(shell, result, groups, open);
  survey_faces(shell, result);
  std::map<std::size_t, Component> components;
  for (const Triangle& t : shell.triangles) {
    for (const Index v : t) used[v] = true;
    components[groups.find(t[0])].volume += six_volumes(shell, t) / 6;
  }
  for (std::size_t v = 0; v < shell.points.size(); ++v) {
    if (!used[v]) ++result.unused_vertices;
    if (!used[v]) continue;
    Component& component = components[groups.find(v)];
    component.points.push_back(shell.points[v]);
    if (open[v]) component.closed = false;
  }
  result.components = components.size();
  result.least_volume = result.least_distance = kInfinity;
  for (auto& [root, component] : components) {
    if (component.closed) result.least_volume = std::min(result.least_volume, component.volume);
    result.least_distance = std::min(result.least_distance, least_distance(component));
  }
  return result;
}

std::string data_file(const std::string& name) {
  return std::string(MESHCONTOUR_TESTS_DIR) + "/unit/sweep/data/" + name;
}

std::string data_bytes(const std::string& name) {
  std::ifstream in(data_file(name), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Model read_text(const std::string& text, const SweepOptions& options) {
  ReadOptions read_options;
  read_options.sweep = options;
  return read_model(text, "text.swp", read_options);
}

double turned_area(const std::vector<Eigen::Vector2d>& polyline, std::size_t steps) {
  const double m = static_cast<double>(steps), c = std::cos(std::numbers::pi / m);
  double sum = 0;
  for (std::size_t j = 0; j + 1 < polyline.size(); ++j) {
    const double x0 = std::abs(polyline[j].x()), x1 = std::abs(polyline[j + 1].x());
    sum += (x0 + x1) * std::hypot(polyline[j + 1].y() - polyline[j].y(), (x1 - x0) * c);
  }
  return m * std::sin(std::numbers::pi / m) * sum;
}

double turned_volume(const std::vector<Eigen::Vector2d>& polyline, std::size_t steps) {
  const double m = static_cast<double>(steps);
  double sum = 0;
  for (std::size_t j = 0; j + 1 < polyline.size(); ++j) {
    const double x0 = polyline[j].x(), x1 = polyline[j + 1].x();
    sum += (x0 * x0 + x0 * x1 + x1 * x1) / 3 * (polyline[j + 1].y() - polyline[j].y());
  }
  return m / 2 * std::sin(2 * std::numbers::pi / m) * std::abs(sum);
}

}  // namespace sweeps

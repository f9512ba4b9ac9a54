// The program of the report that this grew from, made anew from its description: tinyxml2 and string streams
// read, maps and sets find boundary points and edges, edges are put in order by searching for the next and
// printed, and each triangle and each loop is drawn and flushed by itself. Prints the processor time of each
// stage on standard error.
//
// usage: bench_report_program MODEL.xml OUT.png [faces]

#include <GL/glu.h>
#include <GL/osmesa.h>
#include <fmt/format.h>
#include <tinyxml2.h>

#include <array>
#include <cstdlib>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "bench/bench.hpp"
#include "bench/stb_writer.hpp"

namespace {

constexpr int kSide = 500;

using Numbers = std::vector<double>;
using Edge = std::pair<int, int>;

struct Facet {
  std::array<int, 3> vertices{};
  Numbers normal;
  std::vector<Numbers> corner_normals;
};

struct Patch {
  std::vector<Facet> facets;
  std::vector<int> bound_points;
  std::vector<Edge> bound_edges;
  std::vector<std::vector<int>> loops;
};

struct Shell {
  std::vector<Numbers> points;
  std::vector<Patch> patches;
};

Numbers numbers(const char* text) {
  Numbers result;
  std::stringstream stream(text == nullptr ? "" : text);
  for (double number = 0; stream >> number;) result.push_back(number);
  return result;
}

Facet facet_of(const tinyxml2::XMLElement* element) {
  Facet facet;
  std::stringstream stream(element->Attribute("v"));
  for (int& vertex : facet.vertices) stream >> vertex;
  facet.normal = numbers(element->Attribute("fn"));
  for (auto* n = element->FirstChildElement("n"); n != nullptr; n = n->NextSiblingElement("n")) {
    facet.corner_normals.push_back(numbers(n->Attribute("d")));
  }
  return facet;
}

Shell shell_of(const tinyxml2::XMLElement* element) {
  Shell shell;
  const auto* verts = element->FirstChildElement("verts");
  for (auto* v = verts->FirstChildElement("v"); v != nullptr; v = v->NextSiblingElement("v")) {
    shell.points.push_back(numbers(v->Attribute("p")));
  }
  for (auto* block = element->FirstChildElement("facets"); block != nullptr;
       block = block->NextSiblingElement("facets")) {
    Patch& patch = shell.patches.emplace_back();
    for (auto* f = block->FirstChildElement("f"); f != nullptr; f = f->NextSiblingElement("f")) {
      patch.facets.push_back(facet_of(f));
    }
  }
  return shell;
}

std::vector<Shell> load(const char* name) {
  tinyxml2::XMLDocument document;
  if (document.LoadFile(name) != tinyxml2::XML_SUCCESS) std::exit(65);
  std::vector<Shell> shells;
  for (auto* s = document.RootElement()->FirstChildElement("shell"); s != nullptr;
       s = s->NextSiblingElement("shell")) {
    shells.push_back(shell_of(s));
  }
  return shells;
}

// A vertex with as many neighbours as triangles is inside; asked of every vertex of the shell for every
// patch.
void set_bound_points(const Shell& shell, Patch& patch) {
  std::map<int, std::set<int>> neighbours;
  std::map<int, int> triangles;
  for (const Facet& facet : patch.facets) {
    for (const int v : facet.vertices) {
      ++triangles[v];
      for (const int u : facet.vertices) {
        if (u != v) neighbours[v].insert(u);
      }
    }
  }
  for (int v = 0; v < static_cast<int>(shell.points.size()); ++v) {
    if (static_cast<int>(neighbours[v].size()) != triangles[v]) patch.bound_points.push_back(v);
  }
}

// Each edge is followed by the first one that begins where it ends.
void put_in_order(std::vector<Edge>& edges) {
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      if (edges[j].first != edges[i].second) continue;
      std::swap(edges[i + 1], edges[j]);
      break;
    }
  }
}

void set_bound_edges(Patch& patch) {
  std::map<Edge, int> counts;
  for (const Facet& facet : patch.facets) {
    for (std::size_t k = 0; k < 3; ++k) ++counts[std::minmax(facet.vertices[k], facet.vertices[(k + 1) % 3])];
  }
  for (const Facet& facet : patch.facets) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge edge(facet.vertices[k], facet.vertices[(k + 1) % 3]);
      if (counts[std::minmax(edge.first, edge.second)] == 1) patch.bound_edges.push_back(edge);
    }
  }
  put_in_order(patch.bound_edges);
  for (const Edge& edge : patch.bound_edges) {
    std::cout << edge.first << " " << edge.second << std::endl;
    if (patch.loops.empty() || patch.loops.back().front() == patch.loops.back().back())
      patch.loops.push_back({edge.first});
    patch.loops.back().push_back(edge.second);
  }
}

void draw_triangles(const Shell& shell, const Patch& patch) {
  for (const Facet& facet : patch.facets) {
    glBegin(GL_TRIANGLES);
    for (const int v : facet.vertices) glVertex3dv(shell.points[static_cast<std::size_t>(v)].data());
    glEnd();
    glFlush();
  }
}

void draw_points_and_edges(const Shell& shell, const Patch& patch) {
  const auto vertex = [&](int v) { glVertex3dv(shell.points[static_cast<std::size_t>(v)].data()); };
  glBegin(GL_POINTS);
  for (const int v : patch.bound_points) vertex(v);
  glEnd();
  glBegin(GL_LINES);
  for (const Edge& edge : patch.bound_edges) vertex(edge.first), vertex(edge.second);
  glEnd();
  glFlush();
}

void draw_loop(const Shell& shell, const std::vector<int>& loop) {
  const std::size_t n = loop.size() - 1;
  std::vector<float> points, knots;
  for (std::size_t i = 0; i < n + 3; ++i) {
    for (const double x : shell.points[static_cast<std::size_t>(loop[i % n])])
      points.push_back(static_cast<float>(x));
  }
  for (std::size_t i = 0; i < n + 7; ++i) knots.push_back(static_cast<float>(i));
  GLUnurbs* renderer = gluNewNurbsRenderer();
  gluBeginCurve(renderer);
  gluNurbsCurve(renderer, static_cast<GLint>(knots.size()), knots.data(), 3, points.data(), 4,
                GL_MAP1_VERTEX_3);
  gluEndCurve(renderer);
  gluDeleteNurbsRenderer(renderer);
  glFlush();
}

void set_camera() {
  glEnable(GL_DEPTH_TEST);
  glViewport(0, 0, kSide, kSide);
  glMatrixMode(GL_PROJECTION);
  gluPerspective(30, 1, 1, 1000);
  glMatrixMode(GL_MODELVIEW);
  glTranslatef(0, 0, -4);
  glScalef(0.015F, 0.015F, 0.015F);
  glRotatef(45, 1, 1, -1);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

class Clock {
 public:
  void stage(const char* name) {
    const double now = bench::cpu_seconds();
    fmt::print(stderr, "{} {:.1f} ms\n", name, 1000 * (now - last_));
    last_ = now;
  }

 private:
  double last_ = bench::cpu_seconds();
};

template <typename Work>
void each_patch(std::vector<Shell>& shells, const Work& work) {
  for (Shell& shell : shells) {
    for (Patch& patch : shell.patches) work(shell, patch);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 64;
  Clock clock;
  std::vector<Shell> shells = load(argv[1]);
  clock.stage("load");
  each_patch(shells, [](const Shell& shell, Patch& patch) { set_bound_points(shell, patch); });
  clock.stage("boundary points");
  each_patch(shells, [](const Shell&, Patch& patch) { set_bound_edges(patch); });
  clock.stage("boundary edges and loops");
  std::vector<std::uint8_t> pixels(4 * kSide * kSide);
  const OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr);
  if (OSMesaMakeCurrent(context, pixels.data(), GL_UNSIGNED_BYTE, kSide, kSide) != GL_TRUE) return 69;
  set_camera();
  clock.stage("context");
  if (argc > 3) each_patch(shells, draw_triangles);
  clock.stage("triangles");
  each_patch(shells, draw_points_and_edges);
  clock.stage("points and edges");
  each_patch(shells, [](const Shell& shell, const Patch& patch) {
    for (const auto& loop : patch.loops) draw_loop(shell, loop);
  });
  glFinish();
  clock.stage("curves");
  stbi_flip_vertically_on_write(1);
  if (stbi_write_png(argv[2], kSide, kSide, 4, pixels.data(), 0) == 0) return 73;
  clock.stage("picture file");
  return 0;
}

// The picture drawn the way of the report that this grew from, beside ours: glBegin and glFlush for each triangle, a
// GLU renderer and glFlush for each loop; and its curves with one renderer and one flush. Each way draws in a process
// of its own, several pictures, of which the first (with what starts up) and the median of the rest are printed.
//
// usage: bench_report_way MODEL [rounds]

#include <GL/glu.h>
#include <GL/osmesa.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

#include "bench/bench.hpp"
#include "meshcontour/fit.hpp"
#include "meshcontour/read.hpp"
#include "meshcontour/render.hpp"

using namespace meshcontour;

namespace {

constexpr int kSide = 500;

struct Input {
  Model model;
  std::vector<ShellBoundary> boundaries;
  std::vector<Contour> contours;  // control polygons as curves
};

Input input_of(const char* name) {
  Input input;
  std::vector<Diagnostic> diagnostics;
  input.model = read_model(std::filesystem::path(name));
  input.boundaries = extract_boundaries(input.model, {}, diagnostics);
  FitOptions options;
  options.method = FitMethod::Control;
  input.contours = fit_contours(input.model, input.boundaries, options, diagnostics);
  return input;
}

// The report's camera, colours and immediate mode.
class ReportWay {
 public:
  explicit ReportWay(const Input& input) : input_(input) {}

  void start() {
    context_ = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr);
    if (OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, kSide, kSide) != GL_TRUE) std::abort();
    glEnable(GL_DEPTH_TEST);
    glViewport(0, 0, kSide, kSide);
    glMatrixMode(GL_PROJECTION);
    gluPerspective(30, 1, 1, 1000);
    glMatrixMode(GL_MODELVIEW);
    glTranslatef(0, 0, -4);
    glScalef(0.015F, 0.015F, 0.015F);
    glRotatef(45, 1, 1, -1);
  }

  void clear() { glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT); }

  void draw_triangles() {
    for (const Shell& shell : input_.model.shells) {
      for (const Triangle& triangle : shell.triangles) {
        glBegin(GL_TRIANGLES);
        for (const Index v : triangle) glVertex3dv(shell.points[v].data());
        glEnd();
        glFlush();
      }
    }
  }

  void draw_curves(bool one_renderer) {
    GLUnurbs* renderer = one_renderer ? gluNewNurbsRenderer() : nullptr;
    for (std::size_t s = 0; s < input_.boundaries.size(); ++s) {
      for (const PatchBoundary& patch : input_.boundaries[s].patches) {
        for (const BoundaryLoop& loop : patch.loops) {
          if (!one_renderer) renderer = gluNewNurbsRenderer();
          draw_loop(renderer, input_.model.shells[s], loop);
          if (!one_renderer) glFlush();
          if (!one_renderer) gluDeleteNurbsRenderer(renderer);
        }
      }
    }
    if (one_renderer) gluDeleteNurbsRenderer(renderer);
    glFlush();
  }

  void finish() { glFinish(); }

 private:
  void draw_loop(GLUnurbs* renderer, const Shell& shell, const BoundaryLoop& loop) {
    points_.clear();
    knots_.clear();
    const std::size_t n = loop.vertices.size();
    for (std::size_t i = 0; i < n + 3; ++i) {
      for (const double x : shell.points[loop.vertices[i % n]]) points_.push_back(static_cast<float>(x));
    }
    for (std::size_t i = 0; i < n + 7; ++i) knots_.push_back(static_cast<float>(i));
    gluBeginCurve(renderer);
    gluNurbsCurve(renderer, static_cast<GLint>(knots_.size()), knots_.data(), 3, points_.data(), 4,
                  GL_MAP1_VERTEX_3);
    gluEndCurve(renderer);
  }

  const Input& input_;
  OSMesaContext context_ = nullptr;
  std::vector<std::uint8_t> pixels_ = std::vector<std::uint8_t>(4 * kSide * kSide);
  std::vector<float> points_, knots_;
};

RenderOptions options(std::vector<Layer> layers) {
  RenderOptions options;
  options.width = options.height = kSide;
  options.view = View::Report;
  options.layers = std::move(layers);
  options.threads = 1;
  return options;
}

struct Times {
  double first = 0, rest = 0;  // CPU seconds
};

// In a process of its own, as a context stays with the process that made it.
Times times_of(const std::function<void()>& start, const std::function<void()>& draw, int rounds) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) std::abort();
  const pid_t child = fork();
  if (child == 0) {
    Times times;
    bench::Contender contender{"", draw};
    const double begin = bench::cpu_seconds();
    start();
    draw();
    times.first = bench::cpu_seconds() - begin;
    std::vector<bench::Contender> contenders = {contender};
    bench::alternate(contenders, rounds);
    times.rest = contenders[0].median();
    const bool sent = write(ends[1], &times, sizeof times) == sizeof times;
    _exit(sent ? 0 : 1);
  }
  Times times;
  int status = 0;
  const bool good = ::read(ends[0], &times, sizeof times) == sizeof times;
  waitpid(child, &status, 0);
  if (!good || status != 0) std::abort();
  return times;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 64;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
  const Input input = input_of(argv[1]);
  const auto ours = [&](const std::vector<Layer>& layers) {
    return times_of([] {}, [&] { render(input.model, input.boundaries, input.contours, options(layers)); },
                    rounds);
  };
  ReportWay way(input);
  const auto theirs = [&](const std::function<void()>& draw) {
    return times_of([&] { way.start(); }, [&] { way.clear(), draw(), way.finish(); }, rounds);
  };
  const Times curves = ours({Layer::Curves}), mesh = ours({Layer::Mesh});
  fmt::print("| drawn | way | first, ms | next, ms | next / ours |\n|---|---|---:|---:|---:|\n");
  const auto row = [](const char* what, const char* name, const Times& times, const Times& own) {
    fmt::print("| {} | {} | {:.1f} | {:.1f} | {:.2f} |\n", what, name, 1000 * times.first, 1000 * times.rest,
               times.rest / own.rest);
  };
  row("curves", "meshcontour", curves, curves);
  row("curves", "one GLU renderer", theirs([&] { way.draw_curves(true); }), curves);
  row("curves", "a renderer and a flush per loop", theirs([&] { way.draw_curves(false); }), curves);
  row("triangles", "meshcontour", mesh, mesh);
  row("triangles", "a flush per triangle", theirs([&] { way.draw_triangles(); }), mesh);
  return 0;
}

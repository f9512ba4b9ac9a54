// The picture drawn the way of the report that this grew from, beside ours: glBegin and glFlush for each
// triangle, a GLU renderer and glFlush for each loop; and its curves with one renderer and one flush. Ours is
// drawn with 4 samples a pixel, which is its default, and with 1 as the others; ratios are to both. Each way
// draws in a process of its own, several pictures, of which the first (with what starts up) and the median of
// the rest are printed. The model is moved and scaled into the report's view; a flush costs what copying the
// picture does, so there are two sizes.
//
// usage: bench_report_way MODEL|loops [rounds]     loops: 1000 loops of 50 vertices

#include <GL/glu.h>
#include <GL/osmesa.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string_view>

#include "bench/bench.hpp"
#include "meshcontour/fit.hpp"
#include "meshcontour/read.hpp"
#include "meshcontour/render.hpp"

using namespace meshcontour;

namespace {

struct Size {
  int width, height;
};

struct Input {
  Model model;
  std::vector<ShellBoundary> boundaries;
  std::vector<Contour> contours;  // control polygons as curves
};

// Rows of round patches, of as many triangles as vertices.
Model sheet_of_loops() {
  constexpr std::size_t kColumns = 40, kRows = 25, kVertices = 50;
  Shell shell;
  for (std::size_t i = 0; i < kColumns * kRows; ++i) {
    const Point center(3 * double(i % kColumns), 3 * double(i / kColumns), 0);
    const auto middle = static_cast<Index>(shell.points.size());
    shell.points.push_back(center);
    for (std::size_t k = 0; k < kVertices; ++k) {
      const double t = 2 * std::numbers::pi * double(k) / double(kVertices);
      shell.points.push_back(center + (1 + 0.3 * std::cos(5 * t)) * Point(std::cos(t), std::sin(t), 0));
      const auto next = static_cast<Index>((k + 1) % kVertices);
      shell.triangles.push_back({middle, middle + 1 + static_cast<Index>(k), middle + 1 + next});
    }
    shell.patches.push_back({"", {}, i * kVertices, kVertices});
  }
  Model model;
  model.shells.push_back(std::move(shell));
  model.instances.push_back({});
  return model;
}

// The report's camera stands still.
void move_into_view(Model& model) {
  constexpr double kHalf = 45;  // model units
  Box box;
  for (const Shell& shell : model.shells) box.extend(bounding_box(shell));
  const double scale = kHalf / (box.sizes() / 2).norm();
  for (Shell& shell : model.shells) {
    for (Point& p : shell.points) p = scale * (p - box.center());
  }
}

Input input_of(std::string_view name) {
  Input input;
  std::vector<Diagnostic> diagnostics;
  input.model = name == "loops" ? sheet_of_loops() : read_model(std::filesystem::path(name));
  move_into_view(input.model);
  input.boundaries = extract_boundaries(input.model, {}, diagnostics);
  FitOptions options;
  options.method = FitMethod::Control;
  input.contours = fit_contours(input.model, input.boundaries, options, diagnostics);
  return input;
}

// The report's camera, colours and immediate mode.
class ReportWay {
 public:
  ReportWay(const Input& input, const Size& size)
      : input_(input), size_(size), pixels_(4 * std::size_t(size.width) * std::size_t(size.height)) {}

  void start() {
    context_ = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr);
    if (OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, size_.width, size_.height) != GL_TRUE)
      std::abort();
    glEnable(GL_DEPTH_TEST);
    glViewport(0, 0, size_.width, size_.height);
    glMatrixMode(GL_PROJECTION);
    gluPerspective(30, double(size_.width) / size_.height, 1, 1000);
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
  Size size_;
  OSMesaContext context_ = nullptr;
  std::vector<std::uint8_t> pixels_;
  std::vector<float> points_, knots_;
};

RenderOptions options(std::vector<Layer> layers, const Size& size, int samples) {
  RenderOptions options;
  options.width = size.width;
  options.height = size.height;
  options.view = View::Report;
  options.layers = std::move(layers);
  options.samples = samples;
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

// Ours, with 4 samples a pixel and with one.
struct Ours {
  Times four, one;
};

void print_row(const char* what, const Size& size, const char* name, const Times& times, const Ours& own) {
  fmt::print("| {} | {}x{} | {} | {:.1f} | {:.1f} | {:.2f} | {:.2f} |\n", what, size.width, size.height, name,
             1000 * times.first, 1000 * times.rest, own.four.rest / times.rest, own.one.rest / times.rest);
}

void measure(const Input& input, const Size& size, int rounds) {
  const auto times_with = [&](Layer layer, int samples) {
    const RenderOptions how = options({layer}, size, samples);
    const auto draw = [&] { render(input.model, input.boundaries, input.contours, how); };
    return times_of([] {}, draw, rounds);
  };
  const auto ours = [&](const char* what, Layer layer) {
    const Ours own{times_with(layer, 4), times_with(layer, 1)};
    print_row(what, size, "meshcontour", own.four, own);
    print_row(what, size, "meshcontour, a sample a pixel", own.one, own);
    return own;
  };
  ReportWay way(input, size);
  const auto theirs = [&](const std::function<void()>& draw) {
    return times_of([&] { way.start(); }, [&] { way.clear(), draw(), way.finish(); }, rounds);
  };
  const Ours curves = ours("curves", Layer::Curves);
  print_row("curves", size, "one GLU renderer", theirs([&] { way.draw_curves(true); }), curves);
  print_row("curves", size, "a renderer and a flush per loop", theirs([&] { way.draw_curves(false); }),
            curves);
  if (size.width > 500) return;  // a flush per triangle takes minutes
  const Ours mesh = ours("triangles", Layer::Mesh);
  print_row("triangles", size, "a flush per triangle", theirs([&] { way.draw_triangles(); }), mesh);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 64;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
  const Input input = input_of(argv[1]);
  fmt::print("| drawn | size | way | first, ms | next, ms | ours / it | with a sample a pixel |\n");
  fmt::print("|---|---|---|---:|---:|---:|---:|\n");
  for (const Size& size : {Size{500, 500}, Size{1920, 1080}}) measure(input, size, rounds);
  return 0;
}

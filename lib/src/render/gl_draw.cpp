#include "render/gl_draw.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "render/drawn_region.hpp"
#include "render/gl_framebuffer.hpp"
#include "render/gl_readback.hpp"
#include "render/shading.hpp"

namespace meshcontour::detail {
namespace {

// Of llvmpipe: larger viewports and wider lines are cut without an error.
constexpr int kLargestFramebuffer = 16384;
constexpr float kWidestDrawn = 255;  // samples

// A part of the picture, in samples: what is kept of it, and the margin around it into which wide lines
// reach.
struct Tile {
  int left, bottom, width, height, margin;
  int full_width() const { return width + 2 * margin; }
  int full_height() const { return height + 2 * margin; }
};

// Appends the chords of a batch's curves to the vertices.
VertexRange add_chords(const Batch& batch, NurbsTessellator& tessellator, std::vector<Vertex>& vertices) {
  const std::size_t first = vertices.size();
  for (const CurveRun& run : batch.runs) {
    const auto degree = static_cast<std::size_t>(run.degree);
    const std::vector<float> knots = bezier_knots(run.pieces, run.degree);
    const std::size_t floats = (run.pieces * degree + 1) * (run.rational ? 4 : 3);
    // GLU takes one chord more than the whole number below what it is told.
    const float samples = static_cast<float>(run.samples) - 0.5F;
    tessellator.tessellate(
        {run.degree + 1, run.rational, knots, std::span(batch.control).subspan(run.first, floats), samples});
    const auto& points = tessellator.points();
    const auto& starts = tessellator.starts();
    std::size_t next = vertices.size();
    vertices.resize(next + 2 * (points.size() - starts.size()), {.position = {}, .color = run.color});
    for (std::size_t strip = 0; strip < starts.size(); ++strip) {
      const std::size_t end = strip + 1 < starts.size() ? starts[strip + 1] : points.size();
      for (std::size_t i = starts[strip]; i + 1 < end; ++i) {
        vertices[next++].position = points[i];
        vertices[next++].position = points[i + 1];
      }
    }
  }
  return {first, vertices.size() - first};
}

void add_chords(Scene& scene, NurbsTessellator& tessellator) {
  std::size_t chords = 0;  // room for all: growing would copy what is there
  for (const Batch& batch : scene.batches) {
    for (const CurveRun& run : batch.runs) chords += run.pieces * static_cast<std::size_t>(run.samples);
  }
  scene.vertices.reserve(scene.vertices.size() + 2 * chords);
  for (Batch& batch : scene.batches) batch.chords = add_chords(batch, tessellator, scene.vertices);
}

// Clip coordinates of the whole picture to those of a tile.
Eigen::Matrix4d tile_projection(const Scene& scene, const Tile& tile) {
  const double across = scene.samples_across, width = across * scene.width, height = across * scene.height;
  Eigen::Matrix4d to_tile = Eigen::Matrix4d::Identity();
  to_tile(0, 0) = width / tile.full_width();
  to_tile(1, 1) = height / tile.full_height();
  to_tile(0, 3) = (width - 2.0 * (tile.left - tile.margin)) / tile.full_width() - 1;
  to_tile(1, 3) = (height - 2.0 * (tile.bottom - tile.margin)) / tile.full_height() - 1;
  return to_tile * scene.projection;
}

// A tile is a window onto the whole picture's viewport, which changes no coordinate but by whole samples.
// Pictures that are too large for a viewport have one for each tile.
void set_view(const Scene& scene, const Tile& tile) {
  const int width = scene.samples_across * scene.width, height = scene.samples_across * scene.height;
  glMatrixMode(GL_PROJECTION);
  if (std::max(width, height) <= kLargestFramebuffer) {
    glViewport(tile.margin - tile.left, tile.margin - tile.bottom, width, height);
    glLoadMatrixd(scene.projection.data());
  } else {
    glViewport(0, 0, tile.full_width(), tile.full_height());
    glLoadMatrixd(tile_projection(scene, tile).data());
  }
}

// Vertices in their final colours, a part of a range at a time: it stays in the cache. Whole triangles and
// lines.
using Part = std::array<ShadedVertex, 6 << 9>;

void set_state(const Part& part, bool with_depth) {
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
  glVertexPointer(3, GL_FLOAT, sizeof(ShadedVertex), &part[0].position);
  glColorPointer(4, GL_FLOAT, sizeof(ShadedVertex), &part[0].color);
  glEnable(GL_POLYGON_OFFSET_FILL);
  with_depth ? glEnable(GL_DEPTH_TEST) : glDisable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
}

// Faces, lines and points go through the same shaders.
void draw_range(const Scene& scene, const Batch& batch, const VertexRange& range, GLenum mode, Part& part) {
  const bool lit = scene.lit && mode == GL_TRIANGLES;
  const std::span<const Vertex> vertices = std::span(scene.vertices).subspan(range.first, range.count);
  const bool once = !lit && vertices.size() <= part.size();
  if (once) keep_colors(vertices, part);
  glMatrixMode(GL_MODELVIEW);
  for (const Placement& placement : scene.frames[batch.frame]) {
    Eigen::Matrix4f to_eye = placement.to_eye;
    to_eye(2, 3) = static_cast<float>(placement.depth + batch.bias);
    glLoadMatrixf(to_eye.data());
    const FaceLight light(placement, scene.perspective());
    for (std::size_t done = 0; done < vertices.size(); done += part.size()) {
      const auto some = vertices.subspan(done, std::min(part.size(), vertices.size() - done));
      if (lit) {
        light.shade(some, part);
      } else if (!once) {
        keep_colors(some, part);
      }
      glDrawArrays(mode, 0, static_cast<GLsizei>(some.size()));
    }
  }
}

void draw_batch(const Scene& scene, const Batch& batch, Part& part) {
  const auto size = std::min(static_cast<float>(scene.samples_across) * batch.size, kWidestDrawn);
  switch (batch.kind) {
    case Batch::Kind::Triangles:
      draw_range(scene, batch, batch.range, GL_TRIANGLES, part);
      break;
    case Batch::Kind::Lines:
      glLineWidth(size);
      draw_range(scene, batch, batch.range, GL_LINES, part);
      draw_range(scene, batch, batch.chords, GL_LINES, part);
      break;
    case Batch::Kind::Points:
      // Square: after GL_POINT_SMOOTH llvmpipe forgets the polygon offset.
      glPointSize(size);
      draw_range(scene, batch, batch.range, GL_POINTS, part);
      break;
  }
}

// Lines and points of one colour are the same picture whichever is in front.
bool needs_depth(const Scene& scene) {
  const auto differs = [&](const VertexRange& range) {
    const auto begin = scene.vertices.begin() + static_cast<std::ptrdiff_t>(range.first);
    return std::any_of(begin, begin + static_cast<std::ptrdiff_t>(range.count),
                       [&](const Vertex& vertex) { return vertex.color != scene.vertices[0].color; });
  };
  return std::ranges::any_of(scene.batches, [&](const Batch& batch) {
    return batch.kind == Batch::Kind::Triangles || differs(batch.range) || differs(batch.chords);
  });
}

// Half the widest line, in samples: a line as wide as that lies in front of the faces that meet in it,
// however steep they are.
float widest_half(const Scene& scene) {
  float size = 0;
  for (const Batch& batch : scene.batches) {
    if (batch.kind != Batch::Kind::Triangles) size = std::max(size, batch.size);
  }
  return static_cast<float>(scene.samples_across) * size / 2;
}

void draw_batches(const Scene& scene, std::size_t first, std::size_t end, Part& part) {
  for (std::size_t i = first; i < end; ++i) draw_batch(scene, scene.batches[i], part);
  glFinish();
  check_gl("drawing");
}

void draw_tile(const Scene& scene, const Tile& tile, bool with_depth, Part& part) {
  set_view(scene, tile);
  glPolygonOffset(1 + widest_half(scene), 1);
  const auto& color = scene.background;
  glClearColor(static_cast<GLfloat>(color[0]) / 255, static_cast<GLfloat>(color[1]) / 255,
               static_cast<GLfloat>(color[2]) / 255, static_cast<GLfloat>(color[3]) / 255);
  glClear(with_depth ? GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT : GL_COLOR_BUFFER_BIT);
  draw_batches(scene, 0, scene.model_batches, part);
}

// What lies over the model, and whether there was anything.
bool draw_legend(const Scene& scene, Part& part) {
  draw_batches(scene, scene.model_batches, scene.batches.size(), part);
  return scene.model_batches < scene.batches.size();
}

// The last picture's framebuffer serves the next unless it is too small or much too large: most of a small
// picture's time goes into fresh pages.
void bind_framebuffer(int width, int height) {
  static std::unique_ptr<Framebuffer>& last = *new std::unique_ptr<Framebuffer>;  // outlives the rasterizer
  const auto area = [](int a, int b) { return static_cast<std::int64_t>(a) * b; };
  if (last == nullptr || last->width() < width || last->height() < height ||
      area(last->width(), last->height()) > 2 * area(width, height)) {
    last.reset();
    last = std::make_unique<Framebuffer>(width, height);
  }
  last->bind();
}

}  // namespace

void test_context() {
  if (glGetString(GL_RENDERER) == nullptr) {
    throw GlFailure("OpenGL has no name: another OpenGL library stands before the rasterizer's");
  }
  const Framebuffer framebuffer(4, 4);
  glClearColor(0.2F, 0.4F, 0.6F, 0.8F);
  glClear(GL_COLOR_BUFFER_BIT);
  std::array<GLubyte, 4> pixel{};
  glReadPixels(2, 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
  check_gl("the self-test");
  if (pixel != std::array<GLubyte, 4>{51, 102, 153, 204}) {
    throw GlFailure("OpenGL does not draw: a cleared pixel reads back in another colour");
  }
}

bool draw_scene(Scene& scene, int largest_tile, NurbsTessellator& tessellator, Image& image) {
  add_chords(scene, tessellator);
  image.width = scene.width;
  image.height = scene.height;
  fill_background(image, scene.background);
  const Region region = drawn_region(scene);
  if (region.empty()) return false;

  const int across = scene.samples_across, whole = std::max(region.width(), region.height());
  const int limit = std::min(largest_tile, kLargestFramebuffer);
  const int margin = whole <= limit ? 0 : 2 * static_cast<int>(std::ceil(widest_half(scene))) + 2;
  const int side = std::min(whole, limit) - 2 * margin;
  const int width = std::min(side - side % across, region.width());
  const int height = std::min(side - side % across, region.height());
  bind_framebuffer(width + 2 * margin, height + 2 * margin);
  const bool with_depth = needs_depth(scene);
  const auto vertices = std::make_unique<Part>();
  set_state(*vertices, with_depth);
  bool something = false;
  for (int bottom = region.bottom; bottom < region.top; bottom += height) {
    for (int left = region.left; left < region.right; left += width) {
      draw_tile(scene, {left, bottom, width, height, margin}, with_depth, *vertices);
      const Readback part{left / across, bottom / across, width / across,  height / across,
                          margin,        across,          scene.background};
      something = average_into(image, part) || something;
      if (draw_legend(scene, *vertices)) average_into(image, part);
    }
  }
  return something;
}

}  // namespace meshcontour::detail

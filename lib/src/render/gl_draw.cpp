#include "render/gl_draw.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>

#include "render/gl_framebuffer.hpp"
#include "render/gl_readback.hpp"

namespace meshcontour::detail {
namespace {

// Of llvmpipe: larger viewports and wider lines are cut without an error.
constexpr int kLargestFramebuffer = 16384;
constexpr float kWidestLine = 255;

// A part of the picture, in samples: what is kept of it, and the margin around it into which wide lines
// reach.
struct Tile {
  int left, bottom, width, height, margin;
  int full_width() const { return width + 2 * margin; }
  int full_height() const { return height + 2 * margin; }
};

struct Range {
  std::size_t first = 0, count = 0;
};

// Appends the chords of a batch's curves to the vertices.
Range add_chords(const Batch& batch, NurbsTessellator& tessellator, std::vector<Vertex>& vertices) {
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

// For the chords of all batches: growing would copy what is there.
void reserve_chords(Scene& scene) {
  std::size_t chords = 0;
  for (const Batch& batch : scene.batches) {
    for (const CurveRun& run : batch.runs) chords += run.pieces * static_cast<std::size_t>(run.samples);
  }
  scene.vertices.reserve(scene.vertices.size() + 2 * chords);
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

void set_state(const Scene& scene) {
  const Vertex* vertices = scene.vertices.data();
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_NORMAL_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
  glVertexPointer(3, GL_FLOAT, sizeof(Vertex), &vertices->position);
  glNormalPointer(GL_SHORT, sizeof(Vertex), &vertices->normal);
  glColorPointer(4, GL_UNSIGNED_BYTE, sizeof(Vertex), &vertices->color);
  constexpr std::array<GLfloat, 4> direction = {-0.25F, 0.35F, 1.0F,
                                                0.0F};  // over the viewer's left shoulder
  constexpr std::array<GLfloat, 4> none = {0, 0, 0, 1};
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glLightfv(GL_LIGHT0, GL_POSITION, direction.data());
  glLightfv(GL_LIGHT0, GL_AMBIENT, none.data());
  glLightfv(GL_LIGHT0, GL_SPECULAR, none.data());
  glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_TRUE);
  glColorMaterial(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE);
  for (const GLenum what : std::initializer_list<GLenum>{GL_COLOR_MATERIAL, GL_LIGHTING, GL_LIGHT0, GL_NORMALIZE,
                                                         GL_DEPTH_TEST, GL_POLYGON_OFFSET_FILL}) {
    glEnable(what);
  }
  glDepthFunc(GL_LEQUAL);
}

// Lines and points go through the same shaders as faces, under a light that gives them their own colour.
void set_light(bool lit) {
  const GLfloat ambient = lit ? 0.36F : 1.0F, diffuse = lit ? 0.64F : 0.0F;
  glLightModelfv(GL_LIGHT_MODEL_AMBIENT, std::array{ambient, ambient, ambient, 1.0F}.data());
  glLightfv(GL_LIGHT0, GL_DIFFUSE, std::array{diffuse, diffuse, diffuse, 1.0F}.data());
}

void draw_range(const Range& range, const std::vector<Placement>& placements, double bias, GLenum mode) {
  glMatrixMode(GL_MODELVIEW);
  for (const Placement& placement : placements) {
    Eigen::Matrix4f to_eye = placement.to_eye;
    to_eye(2, 3) = static_cast<float>(placement.depth + bias);
    glLoadMatrixf(to_eye.data());
    glFrontFace(placement.mirrored ? GL_CW : GL_CCW);
    // Large ranges go in parts, which hold whole triangles and lines: counts are ints.
    constexpr std::size_t kPart = 6 << 24;
    for (std::size_t done = 0; done < range.count; done += kPart) {
      glDrawArrays(mode, static_cast<GLint>(range.first + done),
                   static_cast<GLsizei>(std::min(kPart, range.count - done)));
    }
  }
}

void draw_batch(const Scene& scene, const Batch& batch, const Range& chords) {
  const auto& placements = scene.frames[batch.frame];
  const Range range{batch.first, batch.count};
  const auto size = std::min(static_cast<float>(scene.samples_across) * batch.size, kWidestLine);
  set_light(scene.lit && batch.kind == Batch::Kind::Triangles);
  switch (batch.kind) {
    case Batch::Kind::Triangles:
      draw_range(range, placements, batch.bias, GL_TRIANGLES);
      break;
    case Batch::Kind::Lines:
      glLineWidth(size);
      draw_range(range, placements, batch.bias, GL_LINES);
      draw_range(chords, placements, batch.bias, GL_LINES);
      break;
    case Batch::Kind::Points:
      // Square: after GL_POINT_SMOOTH llvmpipe forgets the polygon offset.
      glPointSize(size);
      draw_range(range, placements, batch.bias, GL_POINTS);
      break;
  }
}

// Half the widest line, in samples: a line as wide as that lies in front of the faces that meet in it, however steep
// they are.
float widest_half(const Scene& scene) {
  float size = 0;
  for (const Batch& batch : scene.batches) {
    if (batch.kind != Batch::Kind::Triangles) size = std::max(size, batch.size);
  }
  return static_cast<float>(scene.samples_across) * size / 2;
}

void draw_batches(const Scene& scene, std::size_t first, std::size_t end, const std::vector<Range>& chords) {
  for (std::size_t i = first; i < end; ++i) draw_batch(scene, scene.batches[i], chords[i]);
  glFinish();
  check_gl("drawing");
}

void draw_tile(const Scene& scene, const Tile& tile, const std::vector<Range>& chords) {
  glViewport(0, 0, tile.full_width(), tile.full_height());
  glMatrixMode(GL_PROJECTION);
  glLoadMatrixd(tile_projection(scene, tile).data());
  glPolygonOffset(1 + widest_half(scene), 1);
  const auto& color = scene.background;
  glClearColor(static_cast<GLfloat>(color[0]), static_cast<GLfloat>(color[1]), static_cast<GLfloat>(color[2]),
               static_cast<GLfloat>(color[3]));
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  draw_batches(scene, 0, scene.model_batches, chords);
}

// What lies over the model, and whether there was anything.
bool draw_legend(const Scene& scene, const std::vector<Range>& chords) {
  draw_batches(scene, scene.model_batches, scene.batches.size(), chords);
  return scene.model_batches < scene.batches.size();
}

// The last picture's framebuffer serves the next of its size: most of a small picture's time goes into fresh
// pages.
void bind_framebuffer(int width, int height) {
  static std::unique_ptr<Framebuffer>& last = *new std::unique_ptr<Framebuffer>;  // outlives the rasterizer
  if (last == nullptr || last->width() != width || last->height() != height) {
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
  std::vector<Range> chords;
  reserve_chords(scene);
  for (const Batch& batch : scene.batches) chords.push_back(add_chords(batch, tessellator, scene.vertices));
  image.width = scene.width;
  image.height = scene.height;
  image.rgba.assign(4 * static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height), 0);

  const int across = scene.samples_across, whole = across * std::max(scene.width, scene.height);
  const int limit = std::min(largest_tile, kLargestFramebuffer);
  const int margin = whole <= limit ? 0 : 2 * static_cast<int>(std::ceil(widest_half(scene))) + 2;
  const int side = std::min(whole, limit) - 2 * margin;
  const int width = std::min(side - side % across, across * scene.width);
  const int height = std::min(side - side % across, across * scene.height);
  bind_framebuffer(width + 2 * margin, height + 2 * margin);
  set_state(scene);
  bool something = false;
  for (int bottom = 0; bottom < across * scene.height; bottom += height) {
    for (int left = 0; left < across * scene.width; left += width) {
      draw_tile(scene, {left, bottom, width, height, margin}, chords);
      const Readback part{left / across, bottom / across, width / across, height / across, margin, across,
                          scene.background};
      something = average_into(image, part) || something;
      if (draw_legend(scene, chords)) average_into(image, part);
    }
  }
  return something;
}

}  // namespace meshcontour::detail

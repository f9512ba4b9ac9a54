#include "render/gl_draw.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "render/gl_framebuffer.hpp"
#include "render/gl_readback.hpp"

namespace meshcontour::detail {
namespace {

constexpr int kLargestFramebuffer = 16384;  // of llvmpipe; larger viewports are cut without an error

// A part of the picture, in samples: what is kept of it, and the margin around it into which wide lines
// reach.
struct Tile {
  int left, bottom, width, height, margin;
  int full_width() const { return width + 2 * margin; }
  int full_height() const { return height + 2 * margin; }
};

using Lines = std::vector<FlatVertex>;

// Chords of a batch's curves. One knot unit a piece, so that no two knots are too close for GLU however the
// curve is parametrized, and a piece is a Bezier curve, so that runs need no overlap but a point.
Lines curve_lines(const Batch& batch, NurbsTessellator& tessellator) {
  Lines lines;
  std::vector<float> knots;
  for (const CurveRun& run : batch.runs) {
    const auto degree = static_cast<std::size_t>(run.degree);
    knots.assign(1, 0.0F);
    for (std::size_t i = 0; i <= run.pieces; ++i) knots.insert(knots.end(), degree, static_cast<float>(i));
    knots.push_back(static_cast<float>(run.pieces));
    const std::size_t floats = (run.pieces * degree + 1) * (run.rational ? 4 : 3);
    tessellator.tessellate({run.degree + 1, run.rational, knots,
                            std::span(batch.control).subspan(run.first, floats),
                            static_cast<float>(run.samples) - 0.5F});
    const auto& points = tessellator.points();
    const auto& starts = tessellator.starts();
    for (std::size_t strip = 0; strip < starts.size(); ++strip) {
      const std::size_t end = strip + 1 < starts.size() ? starts[strip + 1] : points.size();
      for (std::size_t i = starts[strip]; i + 1 < end; ++i) {
        lines.push_back({points[i], run.color});
        lines.push_back({points[i + 1], run.color});
      }
    }
  }
  return lines;
}

// Clip coordinates of the whole picture to those of a tile.
Eigen::Matrix4d tile_projection(const Scene& scene, const Tile& tile) {
  const double width = 2.0 * scene.width, height = 2.0 * scene.height;
  Eigen::Matrix4d to_tile = Eigen::Matrix4d::Identity();
  to_tile(0, 0) = width / tile.full_width();
  to_tile(1, 1) = height / tile.full_height();
  to_tile(0, 3) = (width - 2.0 * (tile.left - tile.margin)) / tile.full_width() - 1;
  to_tile(1, 3) = (height - 2.0 * (tile.bottom - tile.margin)) / tile.full_height() - 1;
  return to_tile * scene.projection;
}

// A light over the viewer's left shoulder, both sides of a face lit, colours from the vertices.
void set_lighting() {
  constexpr std::array<GLfloat, 4> direction = {-0.35F, 0.45F, 1.0F, 0.0F};
  constexpr std::array<GLfloat, 4> diffuse = {0.72F, 0.72F, 0.72F, 1};
  constexpr std::array<GLfloat, 4> ambient = {0.30F, 0.30F, 0.30F, 1};
  constexpr std::array<GLfloat, 4> none = {0, 0, 0, 1};
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glLightfv(GL_LIGHT0, GL_POSITION, direction.data());
  glLightfv(GL_LIGHT0, GL_DIFFUSE, diffuse.data());
  glLightfv(GL_LIGHT0, GL_AMBIENT, none.data());
  glLightfv(GL_LIGHT0, GL_SPECULAR, none.data());
  glLightModelfv(GL_LIGHT_MODEL_AMBIENT, ambient.data());
  glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_TRUE);
  glColorMaterial(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE);
  glEnable(GL_COLOR_MATERIAL);
  glEnable(GL_LIGHT0);
  glEnable(GL_NORMALIZE);
}

void draw_placed(const std::vector<Placement>& placements, double bias, GLenum mode, std::size_t count) {
  glMatrixMode(GL_MODELVIEW);
  for (const Placement& placement : placements) {
    Eigen::Matrix4d to_eye = placement.to_eye;
    to_eye(2, 3) += bias;
    glLoadMatrixd(to_eye.data());
    glFrontFace(placement.mirrored ? GL_CW : GL_CCW);
    // The count is an int: very large batches go in parts that hold whole triangles and lines.
    constexpr std::size_t kPart = 6 << 24;
    for (std::size_t first = 0; first < count; first += kPart) {
      glDrawArrays(mode, static_cast<GLint>(first), static_cast<GLsizei>(std::min(kPart, count - first)));
    }
  }
}

void draw_triangles(const Batch& batch, const std::vector<Placement>& placements) {
  const LitVertex* corners = batch.corners.data();
  glEnableClientState(GL_NORMAL_ARRAY);
  glVertexPointer(3, GL_FLOAT, sizeof(LitVertex), &corners->position);
  glNormalPointer(GL_SHORT, sizeof(LitVertex), &corners->normal);
  glColorPointer(4, GL_UNSIGNED_BYTE, sizeof(LitVertex), &corners->color);
  glEnable(GL_LIGHTING);
  glEnable(GL_POLYGON_OFFSET_FILL);
  draw_placed(placements, batch.bias, GL_TRIANGLES, batch.corners.size());
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_LIGHTING);
  glDisableClientState(GL_NORMAL_ARRAY);
}

void draw_flat(const Batch& batch, const std::vector<Placement>& placements,
               const std::vector<FlatVertex>& vertices) {
  if (vertices.empty()) return;
  const bool points = batch.kind == Batch::Kind::Points;
  glVertexPointer(3, GL_FLOAT, sizeof(FlatVertex), &vertices.data()->position);
  glColorPointer(4, GL_UNSIGNED_BYTE, sizeof(FlatVertex), &vertices.data()->color);
  if (points) {
    glPointSize(2 * batch.size);
  } else {
    glLineWidth(2 * batch.size);
  }
  draw_placed(placements, batch.bias, points ? GL_POINTS : GL_LINES, vertices.size());
}

// Half the widest line: a line as wide as that lies in front of the faces that meet in it, however steep they
// are.
float widest(const Scene& scene) {
  float size = 0;
  for (const Batch& batch : scene.batches) {
    if (batch.kind != Batch::Kind::Triangles) size = std::max(size, batch.size);
  }
  return size;
}

void draw_tile(const Scene& scene, const Tile& tile, const std::vector<Lines>& curves) {
  glViewport(0, 0, tile.full_width(), tile.full_height());
  glMatrixMode(GL_PROJECTION);
  glLoadMatrixd(tile_projection(scene, tile).eval().data());
  set_lighting();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glPolygonOffset(1 + widest(scene), 1);
  const auto& color = scene.background;
  glClearColor(static_cast<GLfloat>(color[0]), static_cast<GLfloat>(color[1]), static_cast<GLfloat>(color[2]),
               static_cast<GLfloat>(color[3]));
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
  for (std::size_t i = 0; i < scene.batches.size(); ++i) {
    const Batch& batch = scene.batches[i];
    const auto& placements = scene.frames[batch.frame];
    if (batch.kind == Batch::Kind::Triangles) {
      if (!batch.corners.empty()) draw_triangles(batch, placements);
    } else {
      draw_flat(batch, placements, batch.vertices);
      draw_flat(batch, placements, curves[i]);
    }
  }
  glDisableClientState(GL_COLOR_ARRAY);
  glDisableClientState(GL_VERTEX_ARRAY);
  glFinish();
  check_gl("drawing");
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

void draw_scene(const Scene& scene, int largest_tile, NurbsTessellator& tessellator, Image& image) {
  std::vector<Lines> curves;
  for (const Batch& batch : scene.batches) curves.push_back(curve_lines(batch, tessellator));
  image.width = scene.width;
  image.height = scene.height;
  image.rgba.assign(4 * static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height), 0);

  const int whole = std::max(2 * scene.width, 2 * scene.height);
  const int reach = 2 * static_cast<int>(std::ceil(widest(scene))) + 2;
  const int margin = whole <= largest_tile ? 0 : reach;
  const int side = std::min({whole, largest_tile, kLargestFramebuffer}) - 2 * margin;
  const int even_side = side - side % 2;
  const int width = std::min(even_side, 2 * scene.width), height = std::min(even_side, 2 * scene.height);
  const Framebuffer framebuffer(width + 2 * margin, height + 2 * margin);
  for (int bottom = 0; bottom < 2 * scene.height; bottom += height) {
    for (int left = 0; left < 2 * scene.width; left += width) {
      const Tile tile{left, bottom, width, height, margin};
      draw_tile(scene, tile, curves);
      average_into(image, {left / 2, bottom / 2, width / 2, height / 2, margin});
    }
  }
}

}  // namespace meshcontour::detail

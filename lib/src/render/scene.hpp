#pragma once

// What a drawing module is given: plain data, in the order it is drawn. Nothing here knows OpenGL, and a
// module needs nothing else of the library.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// A corner of a triangle, an end of a line or a point. One layout for all, in one array. Positions are in a
/// frame of the shell's own, centred and scaled to [-1, 1].
struct Vertex {
  std::array<float, 3> position;
  std::array<std::int16_t, 4> normal{0, 0, 32767,
                                     0};  ///< times 32767; the fourth only fills; lines need none
  Rgba color;
};

/// Consecutive Bezier pieces of one curve, joined end to start; drawn through one gluNurbsCurve.
struct CurveRun {
  int degree = 3;
  bool rational = false;
  std::size_t pieces = 0;
  std::size_t first =
      0;  ///< into Batch::control: pieces * degree + 1 points of 3 floats, or of 4 (w x, w y, w z, w)
  int samples = 1;  ///< chords a piece, at least
  Rgba color;
};

/// Knots 0, 1, 2, ... of consecutive Bezier pieces. No two are too close for GLU however the curve is
/// parametrized, and runs of pieces need not overlap.
inline std::vector<float> bezier_knots(std::size_t pieces, int degree) {
  std::vector<float> knots(1, 0.0F);
  for (std::size_t i = 0; i <= pieces; ++i) {
    knots.insert(knots.end(), static_cast<std::size_t>(degree), static_cast<float>(i));
  }
  knots.push_back(static_cast<float>(pieces));
  return knots;
}

/// Consecutive ones of Scene::vertices.
struct VertexRange {
  std::size_t first = 0, count = 0;
};

/// Primitives that share a frame, a size and a bias.
struct Batch {
  enum class Kind { Triangles, Lines, Points };

  Kind kind = Kind::Triangles;
  std::size_t frame = 0;       ///< into Scene::frames
  float size = 1;              ///< line width or point diameter, pixels of the picture
  double bias = 0;             ///< drawn nearer to the viewer by this, in eye units
  VertexRange range;           ///< 3 a triangle, 2 a line, 1 a point
  std::vector<CurveRun> runs;  ///< Lines: further lines
  std::vector<float> control;  ///< of the runs
  VertexRange chords;          ///< of the runs, once the module has made them
};

/// One occurrence of a frame. There may be millions; the rasterizer takes single precision, once the bias of
/// a batch has been added to the depth.
struct Placement {
  Eigen::Matrix4f to_eye;
  double depth = 0;  ///< to_eye(2, 3)
  bool mirrored = false;
};

struct Scene {
  int width = 0, height = 0;                 ///< pixels of the picture
  int samples_across = 2;                    ///< a pixel is the mean of that many rows of that many samples
  bool lit = true;                           ///< faces are shaded by light
  Eigen::Matrix4d projection;                ///< eye to clip coordinates
  std::array<std::uint8_t, 4> background{};  ///< red, green, blue times alpha; alpha
  std::vector<std::vector<Placement>>
      frames;                    ///< a shell's, the model's own, and the last for pixels of the picture
  std::vector<Vertex> vertices;  ///< of all batches
  std::vector<Batch> batches;    ///< in drawing order
  std::size_t model_batches =
      0;  ///< the first of these show the model, the rest only how to read the picture

  bool perspective() const { return projection.row(3) != Eigen::RowVector4d(0, 0, 0, 1); }
};

}  // namespace meshcontour::detail

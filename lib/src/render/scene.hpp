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

/// A corner of a lit triangle. Positions are in a frame of the shell's own, centred and scaled to [-1, 1].
struct LitVertex {
  std::array<float, 3> position;
  std::array<std::int16_t, 4> normal;  ///< times 32767; the fourth only fills
  Rgba color;
};

/// A vertex of a line or a point.
struct FlatVertex {
  std::array<float, 3> position;
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

/// Primitives that share a frame, a size and a bias.
struct Batch {
  enum class Kind { Triangles, Lines, Points };

  Kind kind = Kind::Triangles;
  std::size_t frame = 0;             ///< into Scene::frames
  float size = 1;                    ///< line width or point diameter, pixels of the picture
  double bias = 0;                   ///< drawn nearer to the viewer by this, in eye units
  std::vector<LitVertex> corners;    ///< Triangles: 3 a triangle
  std::vector<FlatVertex> vertices;  ///< Lines: 2 a line; Points: 1 a point
  std::vector<CurveRun> runs;        ///< Lines: further lines
  std::vector<float> control;        ///< of the runs
};

/// One occurrence of a frame.
struct Placement {
  Eigen::Matrix4d to_eye;
  bool mirrored = false;
};

struct Scene {
  int width = 0, height = 0;           ///< pixels of the picture
  Eigen::Matrix4d projection;          ///< eye to clip coordinates
  std::array<double, 4> background{};  ///< red, green, blue times alpha; alpha; all 0 to 1
  std::vector<std::vector<Placement>>
      frames;                  ///< a shell's, and the last for what is given in the model's frame
  std::vector<Batch> batches;  ///< in drawing order
};

}  // namespace meshcontour::detail

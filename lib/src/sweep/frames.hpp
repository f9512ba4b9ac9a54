#pragma once

// Frames carried along sampled curves.

#include <vector>

#include "sweep/sampling.hpp"

namespace meshcontour::detail {

/// The frame on one side of a sample.
struct SampleFrame {
  Vector normal = Vector::Zero(), binormal = Vector::Zero();
};

struct CarriedFrames {
  std::vector<SampleFrame> before, after;  ///< one a sample; they differ only at corners
  std::vector<double>
      twist;  ///< rotation about the tangent beyond the rotation-minimizing one, radians a unit of length
  double closing_angle = 0;  ///< as in FramedCurve
};

/// The frames of a curve that is not degenerate, or of a circle. Linear in the samples.
CarriedFrames carry_frames(const SampledCurve& curve, FrameMethod method);

/// The frames with which a curve leaves its samples.
std::vector<CurveFrame> frames_of(const SampledCurve& curve, const CarriedFrames& frames);

/// The normal at the start of a curve: z x tangent, or y x tangent where that is next to zero.
Vector start_normal(const Vector& tangent);

/// The normal after one step of double reflection [Wang, Juettler, Zheng & Liu 2008,
/// doi 10.1145/1330511.1330513], with its tangential part removed.
///
/// @param step     from the first to the second point.
/// @param closest  a step not longer than this is none: the frame only follows the tangent.
Vector reflect_twice(const Vector& normal, const Vector& tangent, const Vector& step,
                     const Vector& next_tangent, double closest);

}  // namespace meshcontour::detail

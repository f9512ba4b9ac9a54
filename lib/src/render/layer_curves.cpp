#include <algorithm>
#include <cmath>
#include <map>

#include "meshcontour/fit.hpp"
#include "render/bezier.hpp"
#include "render/layers.hpp"

namespace meshcontour::detail {
namespace {

constexpr double kTolerance = 0.1;         // of the drawn chords, pixels
constexpr std::size_t kLongestRun = 100;   // pieces; GLU's cost a piece grows beyond
constexpr int kLargestDegree = 23;         // of GLU
constexpr float kCurveWidth = 2.2F;        // pixels
constexpr double kLargestBias = 1.0 / 64;  // eye units

// Curves of one frame and one bias.
class CurveBatch {
 public:
  CurveBatch(const Drawing& drawing, std::size_t frame, Batch batch)
      : frame_(drawing.frames[frame]),
        tolerance_(kTolerance /
                   (drawing.camera.pixels_per_unit * drawing.magnification[frame] * frame_.size)),
        batch_(std::move(batch)) {}

  void add(const Curve& curve, const Rgba& color) {
    if (const auto* line = std::get_if<LineSegment>(&curve)) {
      vertices_.push_back(flat_vertex(frame_, line->start, color));
      vertices_.push_back(flat_vertex(frame_, line->end, color));
    } else if (const auto* bspline = std::get_if<BSplineCurve>(&curve)) {
      add(*bspline, color);
    } else {
      add(to_clamped_bspline(curve), color);
    }
  }

  void append_to(Scene& scene) { append(scene, std::move(batch_), vertices_); }

 private:
  void add(const BSplineCurve& curve, const Rgba& color) {
    if (curve.degree > kLargestDegree) return add_by_evaluation(curve, color);
    const BezierCurve bezier = to_bezier(curve, frame_.center, frame_.size);
    const std::size_t pieces = bezier.pieces();
    errors_.resize(pieces);
    counts_.resize(pieces);
    for (std::size_t i = 0; i < pieces; ++i) {
      errors_[i] = chord_error(bezier, i);
      counts_[i] = chords(errors_[i], tolerance_);
    }
    for (std::size_t first = 0; first < pieces;) {
      const int samples = counts_[first];
      const std::size_t longest = samples == 1 ? pieces : std::min(pieces, first + kLongestRun);
      std::size_t end = first + 1;
      while (end < longest && alike(counts_[end], samples)) ++end;
      if (samples == 1) {
        add_chords(bezier, first, end, color);
      } else {
        add_run(bezier, first, end, samples, color);
      }
      first = end;
    }
  }

  // Pieces that one setting of the samples serves well.
  static bool alike(int chords, int samples) {
    return samples == 1 ? chords == 1 : chords > 1 && chords <= samples && 2 * chords >= samples;
  }

  // Pieces that are as good as straight; of those too short to be told apart a chord stands for several.
  void add_chords(const BezierCurve& bezier, std::size_t first, std::size_t end, const Rgba& color) {
    const auto degree = static_cast<std::size_t>(bezier.degree);
    row_.clear();
    Point start = bezier.control[first * degree].hnormalized();
    for (std::size_t i = first; i < end; ++i) {
      const Point next = bezier.control[(i + 1) * degree].hnormalized();
      row_.push_back({start, next, errors_[i]});
      start = next;
    }
    join_chords(row_, tolerance_);
    for (const Chord& chord : row_) {
      for (const Point& p : {chord.start, chord.end}) {
        const Eigen::Vector3f position = p.cast<float>();
        vertices_.push_back({.position = {position.x(), position.y(), position.z()}, .color = color});
      }
    }
  }

  void add_run(const BezierCurve& bezier, std::size_t first, std::size_t end, int samples,
               const Rgba& color) {
    batch_.runs.push_back(
        {bezier.degree, bezier.rational, end - first, batch_.control.size(), samples, color});
    const std::vector<float> control = packed_control(bezier, first, end - first);
    batch_.control.insert(batch_.control.end(), control.begin(), control.end());
  }

  void add_by_evaluation(const BSplineCurve& curve, const Rgba& color) {
    const std::size_t count = 64 * curve.control_points.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (const std::size_t end : {i, i + 1}) {
        const double s = static_cast<double>(end) / static_cast<double>(count);
        vertices_.push_back(flat_vertex(frame_, evaluate(Curve(curve), s), color));
      }
    }
  }

  LocalFrame frame_;
  double tolerance_;  // in coordinates of the frame
  Batch batch_;
  std::vector<Vertex> vertices_;
  std::vector<double> errors_;  // of the pieces of the curve that is being added: of one chord each
  std::vector<int> counts_;     // of chords for each
  std::vector<Chord> row_;
};

// A curve leaves its loop by up to its deviation, also inwards, where the faces would hide it: it is drawn
// nearer by twice that, in steps of powers of two so that few batches come of it.
double bias_of(const Drawing& drawing, const Contour& contour) {
  const double deviation =
      2 * contour.deviation * drawing.camera.scale * drawing.magnification[contour.shell];
  if (!(deviation > drawing.bias)) return drawing.bias;
  return drawing.bias + std::min(kLargestBias, std::exp2(std::ceil(std::log2(deviation))));
}

Rgba curve_color(const Drawing& drawing, const Curve& curve) {
  return drawing.options.color_by == ColorBy::Type ? type_color(curve) : drawing.palette.curves;
}

void add_model_curves(const Drawing& drawing, Scene& scene) {
  const std::size_t frame = drawing.frames.size() - 1;
  CurveBatch batch(drawing, frame, make_batch(drawing, Batch::Kind::Lines, frame, kCurveWidth));
  for (const NamedCurve& named : drawing.model.curves)
    batch.add(named.curve, curve_color(drawing, named.curve));
  batch.append_to(scene);
}

// The batches of a layer's contours, by shell and bias.
class ContourBatches {
 public:
  explicit ContourBatches(const Drawing& drawing) : drawing_(drawing) {}

  CurveBatch& of(const Contour& contour) {
    const std::pair key(contour.shell, bias_of(drawing_, contour));
    const auto found = batches_.find(key);
    if (found != batches_.end()) return found->second;
    Batch batch = make_batch(drawing_, Batch::Kind::Lines, contour.shell, kCurveWidth);
    batch.bias = key.second;
    return batches_.emplace(key, CurveBatch(drawing_, contour.shell, std::move(batch))).first->second;
  }

  void append_to(Scene& scene) {
    for (auto& [key, batch] : batches_) batch.append_to(scene);
  }

 private:
  const Drawing& drawing_;
  std::map<std::pair<std::size_t, double>, CurveBatch> batches_;
};

}  // namespace

// Curves that patches share are drawn once, in the colour of the first: at one place they would show in
// turns.
void add_curves(const Drawing& drawing, Scene& scene) {
  const auto repeated = repeated_segments(drawing.contours);
  ContourBatches batches(drawing);
  for (std::size_t c = 0; c < drawing.contours.size(); ++c) {
    const Contour& contour = drawing.contours[c];
    if (!placed(drawing, contour.shell)) continue;
    CurveBatch& batch = batches.of(contour);
    for (std::size_t i = 0; i < contour.segments.size(); ++i) {
      if (repeated[c][i]) continue;
      const Curve& curve = contour.segments[i].curve;
      batch.add(curve, patches_have_lines(drawing) ? patch_line_color(drawing, contour.shell, contour.patch)
                                                   : curve_color(drawing, curve));
    }
  }
  batches.append_to(scene);
  add_model_curves(drawing, scene);
}

}  // namespace meshcontour::detail

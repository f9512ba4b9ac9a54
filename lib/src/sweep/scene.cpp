#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <set>

#include "meshcontour/sweep.hpp"
#include "sweep/surface.hpp"

namespace meshcontour {
namespace {

using namespace detail;

constexpr std::uint64_t kMostTriangles = std::uint64_t{1}
                                         << 31;  // of one shell, so that an Index holds its points
constexpr double kReversal = 179 * std::numbers::pi / 180;

std::uint64_t sample_count(const SweepCurve& curve) {
  return curve.pieces() * curve.steps + 1;
}

void check_options(const SweepOptions& options) {
  if (!(options.corner_angle > 0) || options.corner_angle > std::numbers::pi) {
    throw Error(ErrorCode::Usage, "the corner angle must be positive and at most half a turn");
  }
}

void require(bool holds, const char* what, const Spot& spot) {
  if (!holds) throw Error(ErrorCode::Usage, what, spot);
}

void check_scene(const SweepScene& scene) {
  for (const SweepCurve& curve : scene.curves) {
    const std::size_t points = curve.control_points.size();
    const bool chain = curve.kind != SweepCurve::Kind::Bezier || points % 3 == 1;
    const bool circle = curve.kind == SweepCurve::Kind::Circle;
    require(circle ? curve.radius >= 0 : points >= 4 && chain, "the curve has the wrong number of points",
            curve.spot);
    require(curve.steps >= 1, "the curve has no steps", curve.spot);
  }
  for (const SweepSurface& surface : scene.surfaces) {
    const bool revolved = surface.kind == SweepSurface::Kind::Revolution;
    const std::size_t last = revolved ? surface.profile : std::max(surface.profile, surface.sweep);
    require(last < scene.curves.size(), "the surface names a curve that does not exist", surface.spot);
    require(!revolved || surface.steps >= 3, "the revolution has fewer than 3 steps", surface.spot);
  }
}

bool is_point(const SweepCurve& curve) {
  if (curve.kind == SweepCurve::Kind::Circle) return curve.radius == 0;
  return std::ranges::all_of(curve.control_points,
                             [&](const Point& p) { return p == curve.control_points[0]; });
}

// Names that the file gives, and others for what it leaves without.
class Names {
 public:
  explicit Names(const SweepScene& scene) {
    for (const SweepCurve& curve : scene.curves) taken_.insert(curve.name);
    for (const SweepSurface& surface : scene.surfaces) taken_.insert(surface.name);
  }

  std::string name(const std::string& given, const char* kind, std::size_t index) const {
    if (!given.empty()) return given;
    std::string name = fmt::format("{}{}", kind, index + 1);
    while (taken_.contains(name)) name += '_';
    return name;
  }

 private:
  std::set<std::string> taken_;
};

class SceneBuilder {
 public:
  SceneBuilder(const SweepScene& scene, const SweepOptions& options)
      : scene_(scene), options_(options), names_(scene), samples_(scene.curves.size()) {}

  Model build() {
    check_size();
    for (std::size_t i = 0; i < scene_.curves.size(); ++i) add_curve(i);
    for (std::size_t i = 0; i < scene_.surfaces.size(); ++i) add_surface(i);
    return std::move(model_);
  }

 private:
  void check_size() const {
    double all = 0;
    for (const SweepSurface& surface : scene_.surfaces) {
      const SweepCurve& profile = scene_.curves[surface.profile];
      const bool revolved = surface.kind == SweepSurface::Kind::Revolution;
      const double rings =
          static_cast<double>(revolved ? surface.steps : sample_count(scene_.curves[surface.sweep]) - 1);
      const double triangles = 2 * rings * static_cast<double>(sample_count(profile) - 1);
      all += triangles;
      if (all <= static_cast<double>(options_.max_triangles) && triangles <= double{kMostTriangles}) continue;
      throw Error(ErrorCode::OutOfMemory,
                  fmt::format("the surfaces need {:.0f} triangles up to here, more than the limit of {}", all,
                              std::min(options_.max_triangles, kMostTriangles)),
                  surface.spot);
    }
  }

  const SampledCurve& sampled(std::size_t curve) {
    if (!samples_[curve]) samples_[curve] = sample_curve(scene_.curves[curve]);
    return *samples_[curve];
  }

  void warn(std::string message, const Spot& spot) {
    model_.diagnostics.push_back({Diagnostic::Severity::Warning, std::move(message), spot});
  }

  void note(std::string message, const Spot& spot) {
    model_.diagnostics.push_back({Diagnostic::Severity::Note, std::move(message), spot});
  }

  void add_curve(std::size_t index) {
    const SweepCurve& curve = scene_.curves[index];
    if (is_point(curve)) return note("the curve is a single point, and is left out", curve.spot);
    NamedCurve named{names_.name(curve.name, "curve", index), to_curve(curve), {}};
    frames_ += static_cast<double>(sample_count(curve));
    if (frames_ <= static_cast<double>(options_.max_frames)) add_frames(curve, sampled(index), named);
    model_.curves.push_back(std::move(named));
  }

  void add_frames(const SweepCurve& curve, const SampledCurve& samples, NamedCurve& named) {
    if (!samples.has_tangents()) return;
    named.frames = frames_of(samples, carry_frames(samples, options_.frames));
    warn_of_reversals(curve, samples);
  }

  void warn_of_reversals(const SweepCurve& curve, const SampledCurve& samples) {
    const auto reverses = [](const CurveSample& sample) { return sample.turning_angle() > kReversal; };
    const auto count = static_cast<std::size_t>(std::ranges::count_if(samples.samples, reverses));
    if (count > 0) {
      warn(fmt::format("the curve has {} cusp{}, where its tangent reverses", count, count > 1 ? "s" : ""),
           curve.spot);
    }
  }

  void add_surface(std::size_t index) {
    const SweepSurface& surface = scene_.surfaces[index];
    const SweepCurve& profile = scene_.curves[surface.profile];
    Shell shell;
    shell.id = names_.name(surface.name, "surface", index);
    const SurfaceTask task{surface, profile, sampled(surface.profile), options_, model_.diagnostics};
    if (surface.kind == SweepSurface::Kind::Revolution) {
      build_revolution(task, static_cast<std::size_t>(surface.steps), 0, shell);
    } else if (const SweepCurve& path = scene_.curves[surface.sweep]; path.kind == SweepCurve::Kind::Circle) {
      build_revolution(task, static_cast<std::size_t>(path.steps), path.radius, shell);
    } else {
      build_cylinder(task, sampled(surface.sweep), shell);
    }
    if (shell.triangles.empty()) warn("the surface is degenerate: it has no area", surface.spot);
    model_.instances.push_back({model_.shells.size(), Eigen::Affine3d::Identity(), shell.id});
    model_.shells.push_back(std::move(shell));
  }

  const SweepScene& scene_;
  const SweepOptions& options_;
  Names names_;
  std::vector<std::optional<SampledCurve>> samples_;
  double frames_ = 0;
  Model model_;
};

}  // namespace

Model sweep(const SweepScene& scene, const SweepOptions& options) {
  check_options(options);
  check_scene(scene);
  return SceneBuilder(scene, options).build();
}

}  // namespace meshcontour

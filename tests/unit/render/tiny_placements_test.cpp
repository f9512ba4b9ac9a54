// Very many placements that are smaller than samples of the picture.

#include "meshcontour/render.hpp"
#include "render/scene_builder.hpp"
#include "solids.hpp"
#include "support/catch.hpp"
#include "support/pictures.hpp"

using namespace meshcontour;
using namespace solids;

namespace {

constexpr std::size_t kSide = 40;

RenderOptions small(std::vector<Layer> layers) {
  RenderOptions options;
  options.width = 160;
  options.height = 120;
  options.layers = std::move(layers);
  return options;
}

// A block of 1600 boxes, some pixels wide, between two plates that fill the picture; the boxes are placements
// of so many equal shells.
Model dust(double size, std::size_t shells) {
  Model model;
  for (std::size_t i = 0; i < shells; ++i) {
    model.shells.push_back(box({0, 0, 0}, Point::Constant(size), {200, 60, 60, 255}));
  }
  model.shells.push_back(rectangle({-50, -50, 0}, {-40, -40, 0}, {60, 60, 200, 255}));
  model.shells.push_back(rectangle({40, 40, 0}, {50, 50, 0}, {60, 60, 200, 255}));
  for (std::size_t i = 0; i < kSide * kSide; ++i) {
    Instance instance{i % shells, Eigen::Affine3d::Identity(), ""};
    const double x = double(i % kSide), y = double(i / kSide);
    instance.placement.translation() = 0.1 * Vector(x, y, std::sin(x * y));
    instance.placement.linear() = Eigen::AngleAxisd(x + y, Vector(1, 2, 3).normalized()).toRotationMatrix();
    model.instances.push_back(instance);
  }
  for (std::size_t plate = 0; plate < 2; ++plate) {
    model.instances.push_back({shells + plate, Eigen::Affine3d::Identity(), ""});
  }
  return model;
}

}  // namespace

TEST_CASE("render: tiny placements are left out of large crowds, and faces are the same to the byte",
          "[render]") {
  const double size = GENERATE(0.01, 0.1, 0.6, 3.0);
  const auto options = small({Layer::Mesh});
  const Model crowd = dust(size, 1), parts = dust(size, 2);
  CHECK(picture(crowd, options).rgba == picture(parts, options).rgba);
  const auto faces = [&](const Model& model) {
    const detail::Scene scene = detail::build_scene(model, {}, {}, options);
    return scene.frames[scene.batches[0].frame].size();
  };
  CHECK(faces(parts) == kSide * kSide / 2);
  if (size < 0.05) CHECK(faces(crowd) < kSide * kSide / 20);
  if (size > 2) CHECK(faces(crowd) == kSide * kSide);
}

TEST_CASE("render: the lines of tiny placements are dots as wide as they are", "[render]") {
  const auto options = small({Layer::Edges});
  std::vector<Diagnostic> diagnostics;
  const auto scene_of = [&](const Model& model) {
    return detail::build_scene(model, extract_boundaries(model, {}, diagnostics), {}, options);
  };
  const detail::Scene tiny = scene_of(dust(0.01, 1)), large = scene_of(dust(3, 1));
  CHECK(tiny.frames[tiny.batches[0].frame].empty());
  REQUIRE(tiny.batches[1].kind == detail::Batch::Kind::Points);
  CHECK(tiny.batches[1].size == tiny.batches[0].size);
  const std::size_t dots = tiny.frames[tiny.batches[1].frame].size();
  CHECK((dots > kSide && dots < kSide * kSide));
  CHECK(large.frames[large.batches[0].frame].size() == kSide * kSide);
  CHECK(large.frames[large.batches[1].frame].empty());
}

TEST_CASE("render: a crowd looks the same whether or not its members are left out", "[render]") {
  const double size = GENERATE(0.02, 0.05, 3.0);
  const auto options = small({Layer::Edges});
  const Image all = picture(dust(size, 2), options), fewer = picture(dust(size, 1), options);
  CHECK(pictures::differing_share(all, fewer, 64) < 0.005);
  CHECK(pictures::differing_share(fewer, picture(dust(size, 1), small({Layer::Points})), 64) > 0.001);
}

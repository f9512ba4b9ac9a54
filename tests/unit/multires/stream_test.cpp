#include "meshcontour/read.hpp"
#include "meshcontour/wavelet_stream.hpp"
#include "multires/stream_blocks.hpp"
#include "support/catch.hpp"
#include "surfaces.hpp"

using namespace meshcontour;

namespace {

Model sample_model() {
  Model model;
  model.name = "sample";
  model.metres_per_unit = 0.001;
  Shell sphere = surfaces::shuffled(surfaces::bumpy_sphere(4, 0.2), 9);
  sphere.id = "sphere";
  sphere.patches[3].color = {1, 2, 3, 255};
  Shell odd = surfaces::height_field(5, false);
  odd.id = "odd";
  model.shells = {sphere, odd};
  Instance placed;
  placed.shell = 1;
  placed.placement = Eigen::Translation3d(1, 2, 3);
  placed.path = "root/odd";
  model.instances = {{}, placed};
  return model;
}

std::string stream_of(const Model& model, double precision = 1e-6) {
  WaveletStreamOptions options;
  options.precision = precision;
  StringSink sink;
  std::vector<Diagnostic> notes;
  write_wavelet_stream(model, options, sink, notes);
  return sink.text;
}

Model read_back(std::string_view bytes, std::uint64_t most = 1'000'000) {
  return read_wavelet_stream(bytes, "test.mcw", most);
}

// The largest distance of a point to the nearest of the other shell's.
double point_distance(const Shell& from, const Shell& to) {
  double worst = 0;
  for (const Point& p : from.points) {
    double nearest = 1e300;
    for (const Point& q : to.points) nearest = std::min(nearest, (p - q).norm());
    worst = std::max(worst, nearest);
  }
  return worst;
}

}  // namespace

TEST_CASE("wavelet stream: comes back within a few steps, patches and instances whole", "[multires]") {
  const Model model = sample_model();
  const double precision = GENERATE(1e-3, 1e-6);
  const Model back = read_back(stream_of(model, precision));
  CHECK(back.diagnostics.empty());
  CHECK(back.name == "sample");
  CHECK(back.metres_per_unit == 0.001);
  REQUIRE(back.shells.size() == 2);
  CHECK(back.shells[0].triangles.size() == model.shells[0].triangles.size());
  CHECK(back.shells[0].patches[3].color == model.shells[0].patches[3].color);
  const double size = bounding_box(model.shells[0]).diagonal().norm();
  CHECK(point_distance(back.shells[0], model.shells[0]) <= 5 * precision * size);
  CHECK(surfaces::topology_of(back.shells[0]).manifold);
  CHECK(back.shells[1].points == model.shells[1].points);
  CHECK(back.shells[1].triangles == model.shells[1].triangles);
  REQUIRE(back.instances.size() == 2);
  CHECK(back.instances[1].path == "root/odd");
  CHECK(back.instances[1].placement.matrix() == model.instances[1].placement.matrix());
}

TEST_CASE("wavelet stream: many instances come back from few bytes", "[multires]") {
  Model model;
  model.shells = {surfaces::octahedron()};
  for (int i = 0; i < 15000; ++i) {
    Instance placed;
    placed.placement = Eigen::Translation3d(i % 100, i / 100, 0);
    placed.path = std::to_string(i);
    model.instances.push_back(std::move(placed));
  }
  const std::string bytes = stream_of(model);
  CHECK(bytes.size() < 300'000);  // of a million and a half
  const Model back = read_back(bytes);
  REQUIRE(back.instances.size() == model.instances.size());
  bool same = true;
  for (std::size_t i = 0; i < back.instances.size(); ++i) {
    same = same && back.instances[i].path == model.instances[i].path &&
           back.instances[i].placement.matrix() == model.instances[i].placement.matrix();
  }
  CHECK(same);
}

TEST_CASE("wavelet stream: it is recognised by its content", "[multires][read]") {
  const Model model = read_model(stream_of(sample_model()), "unnamed");
  CHECK(model.shells.size() == 2);
}

TEST_CASE("wavelet stream: the same bytes every time", "[multires]") {
  CHECK(stream_of(sample_model()) == stream_of(sample_model()));
}

TEST_CASE("wavelet stream: every beginning with the coarse mesh can be read, longer ones are nearer",
          "[multires]") {
  const Model model = sample_model();
  const std::string whole = stream_of(model);
  std::size_t read = 0;
  double first = 0, last = 0;
  for (std::size_t length = 0; length < whole.size(); length += whole.size() / 40) {
    Model part;
    try {
      part = read_back(whole.substr(0, length));
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::BadData);
      CHECK(read == 0);
      continue;
    }
    CHECK(part.diagnostics.size() == 1);
    CHECK(surfaces::topology_of(part.shells[0]).manifold);
    last = point_distance(model.shells[0], part.shells[0]);
    if (read++ == 0) first = last;
  }
  CHECK(read > 10);
  CHECK(last < 0.1 * first);
}

TEST_CASE("wavelet stream: any changed byte is an error or harmless, never more", "[multires][error]") {
  const std::string whole = stream_of(sample_model(), 1e-3);
  std::mt19937 random(5);
  std::size_t refused = 0;
  const int trials = 400;
  for (int trial = 0; trial < trials; ++trial) {
    std::string damaged = whole;
    damaged[random() % damaged.size()] ^= static_cast<char>(1 << random() % 8);
    try {
      read_back(damaged);
    } catch (const Error& error) {
      ++refused;
      CHECK_THAT(error.what(), Catch::Contains("test.mcw"));
    }
  }
  // What is left are lengths that reach beyond the end: the stream then ends early.
  CHECK(refused > trials * 9 / 10);
}

TEST_CASE("wavelet stream: contents that contradict themselves are refused", "[multires][error]") {
  // Written by hand: blocks are whole, what they say is not.
  struct Case {
    std::uint64_t levels, triangles, corner;
    std::string message;
    double step = 1;
  };
  const auto [levels, triangles, corner, message, step] = GENERATE(values<Case>({
      {17, 1, 2, "out of range"},
      {1, 2, 2, "patches do not make up"},
      {1, 1, 9, "names a point"},
      {16, 1, 2, "triangles"},
      {1, 1, 0, "not an orientable manifold"},
      {1, 1, 2, "a point is out of range", 1e308},
  }));
  CAPTURE(message);
  detail::ByteWriter out;
  out.text("hand");
  out.number(1);
  for (int i = 0; i < 3; ++i) out.byte(1);
  out.count(1);
  out.text("shell");
  for (int i = 0; i < 4; ++i) out.byte(255);
  out.count(levels);
  out.number(step);
  out.count(3);
  for (int i = 0; i < 3; ++i) out.number(i);
  for (const int difference : {0, 1, 0, 0, 0, 1, 0, 2, 3}) out.integer(difference);
  out.count(1);
  out.text("patch");
  for (int i = 0; i < 4; ++i) out.byte(255);
  out.count(1);
  out.count(triangles);
  out.integer(0);
  out.integer(1);
  out.integer(static_cast<std::int64_t>(corner) - 1);
  out.count(0);
  out.count(0);
  StringSink sink;
  detail::BlockWriter blocks(sink);
  blocks.write(detail::BlockKind::Base, out.bytes());
  blocks.end();
  CHECK_THROWS_WITH(read_back(sink.text), Catch::Contains(message));
}

TEST_CASE("wavelet stream: shifts along the surface cost less than those across it", "[multires]") {
  // The same sphere with its points moved at random, by as much, in either direction.
  Model along, across;
  along.shells = across.shells = {surfaces::bumpy_sphere(4, 0)};
  std::mt19937 random(6);
  for (std::size_t v = 0; v < along.shells[0].points.size(); ++v) {
    const Point p = along.shells[0].points[v];
    const double share = 0.003 * surfaces::uniform(random);
    along.shells[0].points[v] += share * p.cross(Vector(p.y(), p.z(), p.x() + 1)).normalized();
    across.shells[0].points[v] += share * p;
  }
  CHECK(10 * stream_of(along, 1e-3).size() < 8 * stream_of(across, 1e-3).size());
}

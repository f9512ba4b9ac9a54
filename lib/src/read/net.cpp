#include "read/net.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "base/line_counter.hpp"
#include "base/text_cursor.hpp"
#include "read/net_checks.hpp"
#include "read/polygon_mesh.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::array<std::string_view, 3> kTextures = {"BaseTexture", "GlossTexture", "EnvTexture"};
constexpr std::size_t kMostCorners = 10;
constexpr std::size_t kLongestName = 79;
constexpr std::size_t kMostUnknownKeywords = 8;  // that are warned of one by one
constexpr double kNormalSize = 6;                // that of the program which this format is from

// Words that begin like one of the keywords v, t, c and f are not taken for comments: they are another
// format's.
bool is_like_keyword(std::string_view word) {
  return word.starts_with('v') || word.starts_with('t') || word.starts_with('c') || word.starts_with('f');
}

class NetReader {
 public:
  NetReader(std::string_view bytes, const ReadContext& context)
      : bytes_(bytes), context_(context), in_(bytes, context.name), mesh_(context) {}

  Model read() && {
    while (!in_.at_end()) read_line();
    check_counts();
    add_triangles();
    check_net(faces_, triangles_, mesh_.points.size(), context_.options,
              [this](std::size_t face, const std::string& why) { fail_at_face(face, why); });
    warn_of_folds();
    if (context_.options.net.normalise) normalise();
    const bool polygons = triangles_.size() > faces_.size();
    Model model = std::move(mesh_).finish();
    model.has_patches = true;
    if (polygons) model.shells[0].polygons = std::move(faces_.polygons);
    for (const Texture& texture : textures_) {
      if (!texture.use.empty()) model.textures.push_back(texture);
    }
    return model;
  }

 private:
  void read_line() {
    const std::string_view keyword = in_.word();
    if (keyword == "v") {
      const auto [x, y, z] = numbers<3>();
      mesh_.points.push_back({x, y, z});
    } else if (keyword == "f") {
      read_face();
    } else if (keyword == "t") {
      const auto [u, v] = numbers<2>();
      mesh_.texture_coordinates.push_back({u, v});
    } else if (keyword == "c") {
      read_color();
    } else if (const auto use = std::ranges::find(kTextures, keyword); use != kTextures.end()) {
      read_texture(textures_[static_cast<std::size_t>(use - kTextures.begin())], keyword);
    } else if (is_like_keyword(keyword)) {
      in_.fail(fmt::format("unknown keyword '{}'", printable(keyword, 40)));
    } else {
      skip_line(keyword);
    }
  }

  template <std::size_t N>
  std::array<double, N> numbers() {
    std::array<double, N> values;
    for (std::size_t i = 0; i < N; ++i) {
      if (in_.at_line_end()) in_.fail(fmt::format("expected {} numbers, found {}", N, i));
      values[i] = in_.number();
    }
    if (!in_.at_line_end()) {
      mesh_.note(Diagnostic::Severity::Warning, "more numbers than the line needs, left out", in_.spot());
    }
    in_.rest_of_line();
    return values;
  }

  void read_color() {
    const std::size_t start = in_.offset() - 1;
    const auto channels = numbers<4>();
    if (std::ranges::any_of(channels, [](double c) { return c < 0 || c > 1; })) {
      fail_at(start, "a colour has numbers from 0 to 1");
    }
    mesh_.point_colors.push_back({channels[0], channels[1], channels[2], channels[3]});
  }

  void read_face() {
    const std::size_t start = in_.offset() - 1;
    Index size = 0;
    for (; !in_.at_line_end(); ++size) {
      const std::string_view word = in_.word();
      const auto corner = parse_integer<Index>(word);
      if (!corner || *corner == std::numeric_limits<Index>::max()) {
        in_.fail(fmt::format("expected an index from 0 up, found '{}'", printable(word, 40)));
      }
      if (size == kMostCorners) in_.fail("a face has 3 to 10 corners, this one has more");
      faces_.polygons.corners.push_back(*corner);
    }
    if (size < 3) in_.fail(fmt::format("a face has 3 to 10 corners, this one has {}", size));
    in_.rest_of_line();
    faces_.polygons.sizes.push_back(size);
    faces_.offsets.push_back(start);
  }

  void read_texture(Texture& texture, std::string_view use) {
    if (in_.at_line_end()) in_.fail("expected the name of a texture");
    const std::string_view name = in_.word();
    if (name.size() > kLongestName)
      in_.fail(fmt::format("the name of a texture has at most {} bytes", kLongestName));
    texture = {std::string(use), std::string(name), texture_size(), texture_size()};
    in_.expect_line_end();
  }

  std::uint32_t texture_size() {
    if (in_.at_line_end()) in_.fail("expected a width and a height");
    return static_cast<std::uint32_t>(in_.integer(1, std::numeric_limits<std::uint32_t>::max()));
  }

  void skip_line(std::string_view keyword) {
    const bool comment = keyword.starts_with('#');
    const Spot spot = comment ? Spot{} : in_.spot();
    in_.rest_of_line();
    if (comment) return;
    const auto known = std::ranges::find(skipped_, keyword);
    const bool listed = known != skipped_.end() || skipped_.size() < kMostUnknownKeywords;
    if (known == skipped_.end() && listed) skipped_.emplace_back(keyword);
    const std::string what = listed ? fmt::format("'{}'", printable(keyword, 40)) : "other words";
    mesh_.note(Diagnostic::Severity::Warning, fmt::format("line that begins with {}, left out", what), spot);
  }

  void check_counts() const {
    const std::size_t points = mesh_.points.size();
    const auto refuse = [&](const std::string& why) {
      throw Error(ErrorCode::BadData, why, {context_.name, 0, 0, ""});
    };
    const auto check = [&](std::size_t count, std::string_view what) {
      if (count > 0 && count != points) refuse(fmt::format("{} {}, but {} points", count, what, points));
    };
    if (points == 0) refuse("no point (a line 'v x y z')");
    if (faces_.size() == 0) refuse("no face (a line 'f' with 3 to 10 indices)");
    check(mesh_.texture_coordinates.size(), "texture coordinates");
    check(mesh_.point_colors.size(), "colours");
  }

  void add_triangles() {
    std::span<const Index> rest = faces_.polygons.corners;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const std::span<const Index> corners = rest.first(faces_.polygons.sizes[f]);
      rest = rest.subspan(corners.size());
      for (const Index corner : corners) {
        if (corner < mesh_.points.size()) continue;
        fail_at_face(f, fmt::format("index {}, but there are {} points", corner, mesh_.points.size()));
      }
      for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        triangles_.push_back({corners[0], corners[i], corners[i + 1]});
        mesh_.add_triangle(triangles_.back());
      }
    }
  }

  void warn_of_folds() {
    const std::vector<std::size_t> folded = folded_faces(faces_, mesh_.points);
    if (folded.empty()) return;
    mesh_.note(Diagnostic::Severity::Warning,
               "face that folds over when it is cut into triangles from its first corner",
               spot_of(faces_.offsets[folded[0]]), folded.size());
  }

  void normalise() {
    Box box;
    for (const Point& p : mesh_.points) box.extend(p);
    double largest = 0;
    for (Point& p : mesh_.points) {
      p = p - box.center();
      largest = std::max(largest, p.cwiseAbs().maxCoeff());
    }
    if (largest == 0) return;
    for (Point& p : mesh_.points) p = p * (kNormalSize / largest);
  }

  Spot spot_of(std::size_t offset) const {
    LineCounter lines{TextSource(bytes_)};
    const std::size_t line = lines.line(offset);
    return {context_.name, line, lines.column(offset), ""};
  }

  [[noreturn]] void fail_at(std::size_t offset, const std::string& why) const {
    throw Error(ErrorCode::BadData, why, spot_of(offset));
  }

  // A face beyond the last: the whole file.
  [[noreturn]] void fail_at_face(std::size_t face, const std::string& why) const {
    if (face < faces_.size()) fail_at(faces_.offsets[face], why);
    throw Error(ErrorCode::BadData, why, {context_.name, 0, 0, ""});
  }

  std::string_view bytes_;
  const ReadContext& context_;
  TextCursor in_;
  PolygonMesh mesh_;
  NetFaces faces_;
  std::vector<Triangle> triangles_;
  std::array<Texture, kTextures.size()> textures_;
  std::vector<std::string> skipped_;
};

}  // namespace

// Textures are in no other format, t and c in none that begins with the same words; v and f alone are OBJ's
// too.
Match sniff_net(std::string_view head, std::uint64_t) {
  TextCursor in(head, "", '#');
  for (bool known = true; !in.at_end(); in.rest_of_line()) {
    const std::string_view word = in.word();
    if (std::ranges::find(kTextures, word) != kTextures.end()) return Match::Sure;
    if (known && (word == "t" || word == "c")) return Match::Sure;
    known = known && (word == "v" || word == "f");
  }
  return Match::IfNamed;
}

Model read_net(std::string_view bytes, const ReadContext& context) {
  return NetReader(bytes, context).read();
}

}  // namespace meshcontour::detail

#include <fmt/compile.h>

#include <algorithm>
#include <limits>
#include <span>
#include <string>

#include "base/text_writer.hpp"
#include "write/mesh_pieces.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::size_t kLongestLine = 79;  // that old readers take
constexpr std::size_t kMostCorners = 10;

Triangle smallest_first(Triangle t) {
  std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  return t;
}

std::vector<Triangle> fans_of(const Polygons& polygons) {
  std::vector<Triangle> triangles;
  std::span<const Index> rest = polygons.corners;
  for (const Index size : polygons.sizes) {
    for (std::size_t i = 1; i + 1 < size; ++i) triangles.push_back({rest[0], rest[i], rest[i + 1]});
    rest = rest.subspan(size);
  }
  return triangles;
}

// Whether the triangles are still those of the polygons, in any order.
bool has_its_polygons(const Shell& shell) {
  if (shell.polygons.sizes.empty()) return false;
  std::vector<Triangle> fans = fans_of(shell.polygons), triangles = shell.triangles;
  if (fans == triangles) return true;
  if (fans.size() != triangles.size()) return false;
  for (std::vector<Triangle>* list : {&fans, &triangles}) {
    std::ranges::transform(*list, list->begin(), smallest_first);
    std::ranges::sort(*list);
  }
  return fans == triangles;
}

// Collects the lines of a net.
class NetWriter {
 public:
  NetWriter(const MeshPieces& mesh, const MeshWriteOptions& options, Sink& sink)
      : mesh_(mesh), single_precision_(options.single_precision), out_(sink) {}

  void write(std::span<const Texture> textures) {
    for (const Texture& t : textures) out_.print("{} {} {} {}\n", t.use, t.name, t.width, t.height);
    for_each_point(mesh_, [&](const Point& p) { numbers('v', {p.data(), 3}); });
    attribute('t', &Shell::texture_coordinates);
    attribute('c', &Shell::point_colors);
    for (const MeshPiece& piece : mesh_.pieces) faces(piece);
    out_.flush();
  }

 private:
  // Only if every shell has it: it belongs to the points by its number.
  template <typename Value>
  void attribute(char keyword, std::vector<Value> Shell::*values) {
    const auto has_it = [&](const MeshPiece& piece) {
      return (piece.shell.*values).size() == piece.shell.points.size();
    };
    if (!std::ranges::all_of(mesh_.pieces, has_it)) return;
    for (const MeshPiece& piece : mesh_.pieces) {
      for (const Value& value : piece.shell.*values)
        numbers(keyword, {value.data(), static_cast<std::size_t>(value.size())});
    }
  }

  void numbers(char keyword, std::span<const double> values) {
    line_.assign(1, keyword);
    for (const double value : values) {
      if (single_precision_) {
        fmt::format_to(std::back_inserter(line_), FMT_COMPILE(" {}"), static_cast<float>(value));
      } else {
        fmt::format_to(std::back_inserter(line_), FMT_COMPILE(" {}"), value);
      }
    }
    if (line_.size() > kLongestLine) drop_leading_zeros();
    end_line();
  }

  // " 0.5" becomes " .5", which is the same number to every reader.
  void drop_leading_zeros() {
    for (std::size_t i = line_.find(" 0."); i != std::string::npos; i = line_.find(" 0.", i))
      line_.erase(i + 1, 1);
  }

  void end_line() {
    line_ += '\n';
    out_.text(line_);
  }

  void faces(const MeshPiece& piece) {
    const Shell& shell = piece.shell;
    if (!has_its_polygons(shell)) {
      for (std::size_t t = 0; t < shell.triangles.size(); ++t) face(piece, piece.triangle(t));
      return;
    }
    std::vector<Index> corners;
    std::span<const Index> rest = shell.polygons.corners;
    for (const Index size : shell.polygons.sizes) {
      corners.assign(rest.begin(), rest.begin() + size);
      if (piece.mirrored) std::reverse(corners.begin() + 1, corners.end());
      polygon(piece, corners);
      rest = rest.subspan(size);
    }
  }

  void polygon(const MeshPiece& piece, std::span<const Index> corners) {
    if (corners.size() <= kMostCorners && face(piece, corners)) return;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      face(piece, Triangle{corners[0], corners[i], corners[i + 1]});
  }

  // Writes nothing and returns false if the line were too long.
  bool face(const MeshPiece& piece, std::span<const Index> corners) {
    line_.assign(1, 'f');
    for (const Index corner : corners) {
      fmt::format_to(std::back_inserter(line_), FMT_COMPILE(" {}"), piece.first_point + corner);
    }
    if (line_.size() > kLongestLine) return false;
    end_line();
    return true;
  }

  const MeshPieces& mesh_;
  bool single_precision_;
  TextWriter out_;
  std::string line_;
};

}  // namespace

void write_net(const MeshPieces& mesh, const Model& model, const MeshWriteOptions& options, Sink& sink) {
  check_count(mesh.points, std::numeric_limits<Index>::max(), "points");
  NetWriter(mesh, options, sink).write(model.textures);
}

}  // namespace meshcontour::detail

#include "read/obj.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "base/text_cursor.hpp"
#include "read/obj_materials.hpp"
#include "read/polygon_mesh.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::array<std::string_view, 11> kKeywords = {"v", "vn", "vt", "f",      "o",     "g",
                                                        "s", "l",  "p",  "usemtl", "mtllib"};
constexpr std::size_t kHeadBytes = 4096;

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const ReadContext& context)
      : in_(bytes, context.name, '#'), context_(context), mesh_(context) {}

  Model read() && {
    while (!in_.at_end()) read_statement();
    for (std::size_t g = 0; g < mesh_.groups.size(); ++g) {
      const auto color = materials_.find(material_of_[g]);
      if (color != materials_.end()) mesh_.groups[g].color = color->second;
    }
    return std::move(mesh_).finish();
  }

 private:
  void read_statement() {
    const std::string_view keyword = in_.word();
    if (keyword == "v") {
      mesh_.points.push_back(read_vector());
    } else if (keyword == "vn") {
      mesh_.normals.push_back(read_vector());
    } else if (keyword == "f" || keyword == "fo") {
      return read_face();
    } else if (keyword == "o") {
      return set_name(object_);
    } else if (keyword == "g") {
      return set_name(group_name_);
    } else if (keyword == "usemtl") {
      return set_name(material_);
    } else if (keyword == "mtllib") {
      return read_materials();
    } else if (keyword != "vt" && keyword != "s") {
      mesh_.note(Diagnostic::Severity::Note, "statement that is no part of a mesh, left out", in_.spot());
    }
    in_.rest_of_line();  // weights and colours of vertices too
  }

  Vector read_vector() {
    const double x = in_.number(), y = in_.number(), z = in_.number();
    return {x, y, z};
  }

  void set_name(std::string& name) {
    name = in_.rest_of_line();
    group_ = std::nullopt;
  }

  // True at the end of the statement; a backslash continues it in the next line.
  bool at_statement_end() {
    while (!in_.at_line_end()) {
      if (in_.peek() != "\\") return false;
      in_.word();
      if (!in_.at_line_end()) in_.fail("'\\' in the middle of a line");
      in_.rest_of_line();
    }
    return true;
  }

  void read_face() {
    corners_.clear();
    corner_normals_.clear();
    while (!at_statement_end()) read_corner(in_.word());
    if (!corner_normals_.empty() && corner_normals_.size() != corners_.size()) {
      in_.fail("some corners of the face have a normal and some have none");
    }
    mesh_.add_polygon(corners_, corner_normals_, current_group());
    in_.rest_of_line();
  }

  // v, v/vt, v//vn or v/vt/vn
  void read_corner(std::string_view word) {
    const std::string_view vertex = word.substr(0, word.find('/'));
    corners_.push_back(resolve(vertex, mesh_.points.size(), "vertex"));
    if (vertex.size() == word.size()) return;
    const std::string_view rest = word.substr(vertex.size() + 1), texture = rest.substr(0, rest.find('/'));
    if (!texture.empty() && !parse_integer<std::int64_t>(texture))
      fail_at(texture, "an index of a texture vertex");
    if (texture.size() == rest.size()) return;
    corner_normals_.push_back(resolve(rest.substr(texture.size() + 1), mesh_.normals.size(), "normal"));
  }

  // Numbers count from 1, or from -1 backwards from the last one so far.
  Index resolve(std::string_view word, std::size_t count, std::string_view what) {
    const auto number = parse_integer<std::int64_t>(word);
    const auto bound = static_cast<std::int64_t>(count);
    if (!number || *number == 0 || *number > bound || *number < -bound) {
      fail_at(word, fmt::format("a {} from 1 to {} or from -1 to -{}", what, count, count));
    }
    return static_cast<Index>(*number > 0 ? *number - 1 : bound + *number);
  }

  [[noreturn]] void fail_at(std::string_view word, std::string_view expected) {
    in_.fail(fmt::format("expected {}, found '{}'", expected, printable(word, 40)));
  }

  Index current_group() {
    if (group_) return *group_;
    const auto [known, is_new] =
        group_of_.try_emplace({object_, group_name_, material_}, mesh_.groups.size());
    if (is_new) {
      std::string name = object_;
      for (const std::string& part : {group_name_, material_}) {
        if (!part.empty()) name += (name.empty() ? "" : "/") + part;
      }
      mesh_.groups.push_back({name, Rgba{}});
      material_of_.push_back(material_);
    }
    group_ = static_cast<Index>(known->second);
    return *group_;
  }

  void read_materials() {
    const std::string name(in_.rest_of_line());
    const Spot spot = in_.spot();
    if (context_.folder == nullptr) return;
    try {
      read_obj_materials(*context_.folder, name, materials_);
    } catch (const Error& error) {
      mesh_.note(Diagnostic::Severity::Note, fmt::format("colours left out: {}", error.what()), spot);
    }
  }

  TextCursor in_;
  const ReadContext& context_;
  PolygonMesh mesh_;
  std::string object_, group_name_, material_;
  std::optional<Index> group_;  // none: to be found again
  std::map<std::array<std::string, 3>, std::size_t> group_of_;
  std::vector<std::string> material_of_;  // one a group
  std::map<std::string, Rgba> materials_;
  std::vector<Index> corners_, corner_normals_;
};

}  // namespace

// A file is taken for OBJ when its first statements are, or nothing but comments comes first.
Match sniff_obj(std::string_view head, std::uint64_t) {
  TextCursor in(head, "", '#');
  for (std::size_t known = 0; known < 3; ++known) {
    if (in.at_end()) return known > 0 || head.size() >= kHeadBytes ? Match::Possible : Match::No;
    if (std::ranges::find(kKeywords, in.word()) == kKeywords.end()) return Match::No;
    in.rest_of_line();
  }
  return Match::Possible;
}

Model read_obj(std::string_view bytes, const ReadContext& context) {
  return ObjReader(bytes, context).read();
}

}  // namespace meshcontour::detail

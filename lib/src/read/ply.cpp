#include "read/ply.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "read/numbered_groups.hpp"
#include "read/ply_header.hpp"
#include "read/ply_values.hpp"
#include "read/polygon_mesh.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::array<std::string_view, 2> kCornerLists = {"vertex_indices", "vertex_index"};
constexpr std::array<std::string_view, 11> kPatchNumbers = {
    "patch",    "patch_id", "face_id",        "region",  "label",    "group",
    "group_id", "material", "material_index", "segment", "object_id"};

// What a property is read for.
enum class Role : std::uint8_t { Skip, X, Y, Z, Corners, PatchNumber, Red, Green, Blue, Alpha };

struct Use {
  PlyProperty property;
  Role role = Role::Skip;
};

std::vector<Use> uses_of(const PlyElement& element) {
  std::vector<Use> uses;
  for (const PlyProperty& property : element.properties) uses.push_back({property, Role::Skip});
  return uses;
}

void set_role(std::vector<Use>& uses, std::string_view name, Role role) {
  const auto use = std::ranges::find_if(uses, [&](const Use& u) {
    return u.property.name == name && u.property.count_type.has_value() == (role == Role::Corners) &&
           (is_integer(u.property.type) || (role != Role::Corners && role != Role::PatchNumber));
  });
  if (use != uses.end()) use->role = role;
}

bool has_role(const std::vector<Use>& uses, Role role) {
  return std::ranges::find(uses, role, &Use::role) != uses.end();
}

std::vector<Use> uses_of_vertex(const PlyElement& element) {
  std::vector<Use> uses = uses_of(element);
  set_role(uses, "x", Role::X);
  set_role(uses, "y", Role::Y);
  set_role(uses, "z", Role::Z);
  return uses;
}

std::vector<Use> uses_of_face(const PlyElement& element) {
  std::vector<Use> uses = uses_of(element);
  for (const std::string_view name : kCornerLists) {
    if (!has_role(uses, Role::Corners)) set_role(uses, name, Role::Corners);
  }
  for (const std::string_view name : kPatchNumbers) {
    if (!has_role(uses, Role::PatchNumber)) set_role(uses, name, Role::PatchNumber);
  }
  set_role(uses, "red", Role::Red);
  set_role(uses, "green", Role::Green);
  set_role(uses, "blue", Role::Blue);
  set_role(uses, "alpha", Role::Alpha);
  return uses;
}

std::uint8_t channel(double value, PlyType type) {
  const double scale = is_integer(type) ? 1 : 255;
  return static_cast<std::uint8_t>(std::lround(std::clamp(scale * value, 0.0, 255.0)));
}

template <typename Values>
class PlyBody {
 public:
  PlyBody(const PlyHeader& header, Values& values, const ReadContext& context)
      : header_(header), values_(values), mesh_(context), groups_(mesh_) {}

  Model read() && {
    for (const PlyElement& element : header_.elements) {
      values_.begin_elements(element.name);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element, 0, [this](const Face& face) { add_face(face); });
      } else if (element.name == "tristrips") {
        read_faces(element, -1, [this](const Face& face) { add_strip(face); });
      } else {
        skip(element);
      }
    }
    if (!values_.at_end()) {
      mesh_.note(Diagnostic::Severity::Warning, "bytes after the last element, left out", values_.spot());
    }
    return std::move(mesh_).finish();
  }

 private:
  struct Face {
    std::vector<std::int64_t> corners;
    std::int64_t lowest_corner = 0;  // -1 where it separates strips
    std::int64_t patch = 0;
    Rgba color;
    bool has_patch = false;
  };

  void skip_value(const PlyProperty& property) {
    const std::size_t count =
        property.count_type ? values_.list_length(*property.count_type, property.type) : 1;
    values_.skip(property.type, count);
  }

  void skip(const PlyElement& element) {
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) skip_value(property);
      values_.end_element();
    }
  }

  void read_vertices(const PlyElement& element) {
    const std::vector<Use> uses = uses_of_vertex(element);
    for (const Role role : {Role::X, Role::Y, Role::Z}) {
      if (!has_role(uses, role)) values_.fail("vertices need the properties x, y and z");
    }
    mesh_.points.reserve(mesh_.points.size() + element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      Point point;
      for (const auto& [property, role] : uses) {
        if (role == Role::Skip) {
          skip_value(property);
        } else {
          point[static_cast<Eigen::Index>(role) - static_cast<Eigen::Index>(Role::X)] =
              values_.number(property.type);
        }
      }
      mesh_.points.push_back(point);
      values_.end_element();
    }
  }

  template <typename Add>
  void read_faces(const PlyElement& element, std::int64_t lowest_corner, Add&& add) {
    const std::vector<Use> uses = uses_of_face(element);
    if (!has_role(uses, Role::Corners)) values_.fail("faces need a list vertex_indices of whole numbers");
    Face face;
    face.lowest_corner = lowest_corner;
    face.has_patch = has_role(uses, Role::PatchNumber);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const auto& [property, role] : uses) read_face_value(property, role, face);
      add(face);
      values_.end_element();
    }
  }

  void read_face_value(const PlyProperty& property, Role role, Face& face) {
    switch (role) {
      case Role::Corners:
        face.corners.resize(values_.list_length(*property.count_type, property.type));
        for (std::int64_t& corner : face.corners) corner = read_corner(property.type, face.lowest_corner);
        break;
      case Role::PatchNumber:
        face.patch = values_.integer(property.type);
        break;
      case Role::Red:
        face.color.red = channel(values_.number(property.type), property.type);
        break;
      case Role::Green:
        face.color.green = channel(values_.number(property.type), property.type);
        break;
      case Role::Blue:
        face.color.blue = channel(values_.number(property.type), property.type);
        break;
      case Role::Alpha:
        face.color.alpha = channel(values_.number(property.type), property.type);
        break;
      default:
        skip_value(property);
    }
  }

  std::int64_t read_corner(PlyType type, std::int64_t lowest) {
    const std::int64_t corner = values_.integer(type);
    if (corner < lowest || corner >= static_cast<std::int64_t>(mesh_.points.size())) {
      values_.fail(fmt::format("vertex {}, but there are {}", corner, mesh_.points.size()));
    }
    return corner;
  }

  Index group_of(const Face& face) {
    return groups_.group(face.has_patch ? face.patch : color_key(face.color), face.color);
  }

  void add_face(const Face& face) {
    corners_.clear();
    for (const std::int64_t corner : face.corners) corners_.push_back(static_cast<Index>(corner));
    mesh_.add_polygon(corners_, {}, group_of(face));
  }

  // Strips follow one another, separated by -1; every second triangle of a strip is turned.
  void add_strip(const Face& face) {
    std::size_t start = 0;
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
      if (face.corners[i] == -1) start = i + 1;
      if (i < start + 2) continue;
      const auto corner = [&](std::size_t k) { return static_cast<Index>(face.corners[k]); };
      const Index a = corner(i - 2), b = corner(i - 1), c = corner(i);
      if (a == b || b == c || c == a) continue;  // how strips turn corners
      mesh_.add_triangle((i - start) % 2 == 0 ? Triangle{a, b, c} : Triangle{b, a, c}, group_of(face));
    }
  }

  const PlyHeader& header_;
  Values& values_;
  PolygonMesh mesh_;
  NumberedGroups groups_;
  std::vector<Index> corners_;
};

}  // namespace

Match sniff_ply(std::string_view head, std::uint64_t) {
  return head.starts_with("ply\n") || head.starts_with("ply\r") ? Match::Sure : Match::No;
}

Model read_ply(std::string_view bytes, const ReadContext& context) {
  TextCursor in(bytes, context.name);
  const PlyHeader header = read_ply_header(in);
  if (header.encoding == PlyEncoding::Text) {
    PlyTextValues values(in);
    return PlyBody<PlyTextValues>(header, values, context).read();
  }
  PlyBinaryValues values(bytes.substr(in.offset()), context.name, header.encoding == PlyEncoding::BigEndian);
  return PlyBody<PlyBinaryValues>(header, values, context).read();
}

}  // namespace meshcontour::detail

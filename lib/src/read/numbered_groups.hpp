#pragma once

#include <cstdint>
#include <map>

#include "read/polygon_mesh.hpp"

namespace meshcontour::detail {

/// Groups of a mesh by a number that its polygons carry: a colour, or a patch number.
class NumberedGroups {
 public:
  explicit NumberedGroups(PolygonMesh& mesh) : mesh_(mesh) {}

  /// The group of a key; made on its first use.
  Index group(std::int64_t key, const Rgba& color) {
    if (key == last_key_ && !group_of_.empty()) return last_group_;
    const auto [known, is_new] = group_of_.try_emplace(key, static_cast<Index>(mesh_.groups.size()));
    if (is_new) mesh_.groups.push_back({"", color});
    last_key_ = key;
    return last_group_ = known->second;
  }

 private:
  PolygonMesh& mesh_;
  std::map<std::int64_t, Index> group_of_;
  std::int64_t last_key_ = 0;
  Index last_group_ = 0;
};

inline std::int64_t color_key(const Rgba& color) {
  return std::int64_t{color.red} << 24 | color.green << 16 | color.blue << 8 | color.alpha;
}

}  // namespace meshcontour::detail

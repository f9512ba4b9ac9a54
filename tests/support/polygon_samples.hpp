#pragma once

// Small polygon files in every dialect, as text and bytes.

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace samples {

template <typename T>
void append(std::string& bytes, T value, bool big_endian = false) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), &value, sizeof(T));
  if (big_endian) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

// A facet of a binary STL, with a normal that is no number, as some programs write it.
inline void append_facet(std::string& bytes, const std::array<float, 9>& corners) {
  for (int i = 0; i < 3; ++i) append(bytes, std::bit_cast<float>(0x7fc00000));
  for (const float value : corners) append(bytes, value);
  append(bytes, std::uint16_t{0x8001});
}

// A square of two facets; `header` fills the first 80 bytes.
inline std::string binary_stl(std::string_view header = "solid by name only") {
  std::string bytes(header);
  bytes.resize(80, ' ');
  append(bytes, std::uint32_t{2});
  append_facet(bytes, {0, 0, 0, 1, 0, 0, 1, 1, 0});
  append_facet(bytes, {-0.0f, 0, 0, 1, 1, 0, 0, 1, 0});
  return bytes;
}

inline const std::string_view kTextStl = R"(solid two words
  facet normal 0 0 nan
    outer loop
      vertex 0 0 0
      vertex 1 0 0
      vertex 1.0e+000 1 0
    endloop
  endfacet
  FACET NORMAL 0 0 1
    OUTER LOOP
      VERTEX 0 0 0
      VERTEX 1 1 0
      VERTEX 0 1 0
    ENDLOOP
  ENDFACET
endsolid two words
)";

inline const std::string_view kOff = R"(OFF # a square
# counts
4 1 0

0 0 0
1 0 0 # a corner
1 1 0
0 1 0
4 0 1 2 3
)";

inline const std::string_view kObj = R"(# a square
mtllib none.mtl
o plate
v 0 0 0
v 1 0 0 1.0
v 1 1 0 0.5 0.5 0.5
v 0 1 0
vt 0 0
vn 0 0 2
s off
g upper
usemtl steel
f 1/1/1 2//1 -2/1/-1 \
  -1//1
)";

inline const std::string_view kTextPly = R"(ply
format ascii 1.0
comment a square
obj_info none
element vertex 4
property float x
property float y
property float z
property uchar red
element face 1
property uchar flags
property list uchar int vertex_indices
property list uchar float texcoord
element edge 1
property int vertex1
property int vertex2
end_header
0 0 0 255
1 0 0 255
1 1 0 255
0 1 0 255
7 4 0 1 2 3 2 0.5 0.5
0 1
)";

inline std::string binary_ply(bool big_endian) {
  std::string bytes =
      "ply\nformat binary_" + std::string(big_endian ? "big" : "little") +
      "_endian 1.0\nelement vertex 4\nproperty double x\nproperty float y\nproperty list char short "
      "extra\nproperty float z\nelement face 1\nproperty list ushort uint vertex_index\nend_header\n";
  const std::array<std::array<float, 3>, 4> corners = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  for (const auto& [x, y, z] : corners) {
    append(bytes, double{x}, big_endian);
    append(bytes, y, big_endian);
    append(bytes, std::int8_t{1}, big_endian);
    append(bytes, std::int16_t{-300}, big_endian);
    append(bytes, z, big_endian);
  }
  append(bytes, std::uint16_t{4}, big_endian);
  for (std::uint32_t v = 0; v < 4; ++v) append(bytes, v, big_endian);
  return bytes;
}

// Every sample with a name whose extension fits; each holds the unit square.
inline std::vector<std::pair<std::string, std::string>> all() {
  return {{"text.stl", std::string(kTextStl)}, {"binary.stl", binary_stl()},
          {"a.off", std::string(kOff)},        {"a.obj", std::string(kObj)},
          {"text.ply", std::string(kTextPly)}, {"little.ply", binary_ply(false)},
          {"big.ply", binary_ply(true)}};
}

}  // namespace samples

#include "write/glb_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>

#include "base/escape.hpp"
#include "meshcontour/error.hpp"
#include "meshcontour/version.hpp"

namespace meshcontour::detail {
namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they stand in memory");
static_assert(sizeof(Eigen::Vector3f) == 12);

constexpr std::uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr int kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementArrayBuffer = 34963;

// A channel of an sRGB colour as glTF's factors have it. [IEC 61966-2-1]
double linear(std::uint8_t channel) {
  const double value = channel / 255.0;
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

std::string base_color(const Rgba& color) {
  return fmt::format("\"baseColorFactor\":[{:.5g},{:.5g},{:.5g},1],\"metallicFactor\":0", linear(color.red),
                     linear(color.green), linear(color.blue));
}

// As doubles, which a reader compares with the stored values.
std::string vector_text(const Eigen::Vector3f& v) {
  return fmt::format("[{},{},{}]", static_cast<double>(v.x()), static_cast<double>(v.y()),
                     static_cast<double>(v.z()));
}

template <typename T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

void write_words(Sink& sink, std::initializer_list<std::uint32_t> words) {
  for (const std::uint32_t word : words) sink.write({reinterpret_cast<const char*>(&word), sizeof word});
}

}  // namespace

void check_glb_size(std::uint64_t bytes) {
  if (bytes <= std::numeric_limits<std::uint32_t>::max()) return;
  throw Error(ErrorCode::BadData, "the model needs a .glb of more than 4 GB, which the format cannot hold");
}

std::size_t JsonArray::add(std::string_view element) {
  if (!elements_.empty()) elements_ += ",\n";
  elements_ += element;
  return count_++;
}

void GlbFile::check_size() const {
  check_glb_size(bytes_of(vertices_).size() + bytes_of(indices_).size());
}

std::size_t GlbFile::add_vertices(Vertices vertices, const std::string& bounds) {
  const std::size_t offset = bytes_of(vertices_).size();
  vertices_.insert(vertices_.end(), vertices.begin(), vertices.end());
  check_size();
  return accessors_.add(fmt::format(
      "{{\"bufferView\":0,\"byteOffset\":{},\"componentType\":{},\"count\":{},\"type\":\"VEC3\"{}}}", offset,
      kFloat, vertices.size(), bounds));
}

std::size_t GlbFile::add_positions(Vertices positions) {
  Eigen::Vector3f low = positions.front(), high = low;
  for (const Eigen::Vector3f& p : positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return add_vertices(positions, fmt::format(",\"min\":{},\"max\":{}", vector_text(low), vector_text(high)));
}

std::size_t GlbFile::add_normals(Vertices normals) {
  return add_vertices(normals, "");
}

std::size_t GlbFile::add_indices(std::span<const std::uint32_t> indices) {
  const std::size_t offset = bytes_of(indices_).size();
  indices_.insert(indices_.end(), indices.begin(), indices.end());
  check_size();
  return accessors_.add(fmt::format(
      "{{\"bufferView\":1,\"byteOffset\":{},\"componentType\":{},\"count\":{},\"type\":\"SCALAR\"}}", offset,
      kUnsignedInt, indices.size()));
}

std::size_t GlbFile::surface(const Rgba& color) {
  const std::string name = fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue);
  const auto [known, is_new] = known_materials_.try_emplace(name, 0);
  if (is_new) {
    known->second = materials_.add(fmt::format(
        "{{\"name\":\"{}\",\"pbrMetallicRoughness\":{{{},\"roughnessFactor\":0.6}},\"doubleSided\":true}}",
        name, base_color(color)));
  }
  return known->second;
}

std::size_t GlbFile::line(std::string_view name, const Rgba& color) {
  const auto [known, is_new] = known_materials_.try_emplace(std::string(name), 0);
  if (is_new) {
    known->second = materials_.add(fmt::format(
        "{{\"name\":{},\"pbrMetallicRoughness\":{{{}}},\"extensions\":{{\"KHR_materials_unlit\":{{}}}}}}",
        json_quoted(name), base_color(color)));
  }
  return known->second;
}

std::string GlbFile::json(std::size_t root) const {
  std::string out = fmt::format(
      "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"meshcontour {}\"}},\n\"scene\":0,"
      "\"scenes\":[{{\"nodes\":[{}]}}],\n\"nodes\":{}",
      version(), root, nodes_.text());
  if (!meshes_.empty()) {
    const std::size_t vertex_bytes = bytes_of(vertices_).size(), index_bytes = bytes_of(indices_).size();
    out += fmt::format(
        ",\n\"meshes\":{},\n\"materials\":{},\n\"accessors\":{},\n\"bufferViews\":["
        "{{\"buffer\":0,\"byteLength\":{},\"byteStride\":12,\"target\":{}}},"
        "{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{},\"target\":{}}}],\n\"buffers\":[{{\"byteLength\":"
        "{}}}]",
        meshes_.text(), materials_.text(), accessors_.text(), vertex_bytes, kArrayBuffer, vertex_bytes,
        index_bytes, kElementArrayBuffer, vertex_bytes + index_bytes);
    if (out.find("KHR_materials_unlit") != out.npos) out += ",\n\"extensionsUsed\":[\"KHR_materials_unlit\"]";
  }
  out += '}';
  out.resize((out.size() + 3) / 4 * 4, ' ');
  return out;
}

void GlbFile::write(std::size_t root, Sink& sink) const {
  const std::string text = json(root);
  const std::uint64_t binary = bytes_of(vertices_).size() + bytes_of(indices_).size();
  const std::uint64_t size =
      kHeaderBytes + kChunkHeaderBytes + text.size() + (binary > 0 ? kChunkHeaderBytes + binary : 0);
  check_glb_size(size);
  write_words(sink, {kMagic, 2, static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(text.size()),
                     kJsonChunk});
  sink.write(text);
  if (binary == 0) return;
  write_words(sink, {static_cast<std::uint32_t>(binary), kBinaryChunk});
  sink.write(bytes_of(vertices_));
  sink.write(bytes_of(indices_));
}

}  // namespace meshcontour::detail

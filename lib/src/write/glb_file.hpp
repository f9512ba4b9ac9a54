#pragma once

// The file that glTF 2.0 calls GLB: a chunk of JSON and one of binary data [Khronos, glTF 2.0 Specification].

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "meshcontour/output.hpp"
#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// @throws Error  BadData if a file of so many bytes is beyond what a GLB's header can tell.
void check_glb_size(std::uint64_t bytes);

/// The elements of a JSON array; they are named by their numbers, from 0.
class JsonArray {
 public:
  std::size_t add(std::string_view element);
  bool empty() const { return count_ == 0; }
  /// With brackets.
  std::string text() const { return "[" + elements_ + "]"; }

 private:
  std::string elements_;
  std::size_t count_ = 0;
};

/// A GLB in the making: everything is kept in memory until write(), as the JSON comes first.
class GlbFile {
 public:
  using Vertices = std::span<const Eigen::Vector3f>;

  /// One accessor each; none may be empty.
  /// @throws Error  BadData if the file becomes too large.
  std::size_t add_positions(Vertices positions);  ///< finite
  std::size_t add_normals(Vertices normals);      ///< of length 1
  std::size_t add_indices(std::span<const std::uint32_t> indices);

  /// The material of that colour (sRGB, opaque): lit from both sides, or of lines, which are not lit.
  std::size_t surface(const Rgba& color);
  std::size_t line(std::string_view name, const Rgba& color);

  std::size_t add_mesh(std::string_view element) { return meshes_.add(element); }
  std::size_t add_node(std::string_view element) { return nodes_.add(element); }

  /// @param root     the node that holds all others.
  /// @throws Error   BadData if the file is too large; InputOutput from the sink.
  void write(std::size_t root, Sink& sink) const;

 private:
  std::size_t add_vertices(Vertices vertices, const std::string& bounds);
  void check_size() const;
  std::string json(std::size_t root) const;

  JsonArray nodes_, meshes_, materials_, accessors_;
  std::map<std::string, std::size_t> known_materials_;
  std::vector<Eigen::Vector3f> vertices_;
  std::vector<std::uint32_t> indices_;
};

}  // namespace meshcontour::detail

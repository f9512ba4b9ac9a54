#pragma once

#include <cstddef>
#include <vector>

#include "meshcontour/model.hpp"
#include "read/format.hpp"
#include "read/webxml_content.hpp"

namespace meshcontour::detail {

/// The products and shapes of a file with every reference resolved to an index.
struct WebxmlGraph {
  struct Child {
    std::size_t shape = 0;
    Eigen::Affine3d placement;
  };
  struct Shape {
    std::vector<std::size_t> shells, annotations;
    std::vector<Child> children;
  };
  struct Root {
    std::string path;  ///< of the product
    std::size_t shape = 0;
  };
  std::vector<Shape> shapes;  ///< parallel to WebxmlDocument::shapes
  std::vector<Root> roots;
  std::vector<std::size_t> used_shapes;  ///< reachable from the roots, children before parents
  std::vector<bool> shadowed_shells;  ///< parallel to WebxmlDocument::shells: a later element has the same id
  std::string name;                   ///< of the first root product
};

/// Resolves the references of a file. What names nothing is left out with a warning; of two elements with one
/// id the last counts. Without usable roots, the products (or shapes) that no other names take their place.
///
/// @throws Error  BadData if shapes contain one another, naming the cycle.
WebxmlGraph resolve_references(WebxmlFile& file);

/// What placing everything would give, counted without doing it; counts stick at the highest number.
struct AssemblySize {
  std::uint64_t instances = 0, triangles = 0, annotation_points = 0;
  std::uint64_t visits = 0;  ///< shapes to be looked at on the way
};

/// @param shells, polylines  as in WebxmlFile; may still be without content, then triangles and points count
/// as 0.
AssemblySize measure_assembly(const WebxmlGraph& graph, const WebxmlFile& file);

/// @throws Error  OutOfMemory, with the number, if the assembly is beyond a limit.
void check_limits(const AssemblySize& size, const ReadOptions& options, const std::string& file);

/// Places shells and annotations: appends to Model::instances and Model::annotations.
void place_assembly(const WebxmlGraph& graph, WebxmlFile& file, Model& model);

/// Metres per unit of the model, 0 if it is not known; unknown and mixed units are reported.
double model_unit(const WebxmlGraph& graph, WebxmlFile& file);

}  // namespace meshcontour::detail

#pragma once

// Small webxml documents for the tests.

#include <string>
#include <string_view>

#include "meshcontour/read.hpp"
#include "read/webxml.hpp"

namespace webxml_text {

using namespace meshcontour;

inline const std::string kPoints =
    "<verts>\n<v p=\"0 0 0\"/>\n<v p=\"1 0 0\"/>\n<v p=\"1 1 0\"/>\n<v p=\"0 1 0\"/>\n</verts>\n";
inline const std::string kSquare =
    "<facets color=\"00ff00\">\n"
    "<f v=\"0 1 2\" fn=\"0 0 1\">\n<n d=\"0 0 1\"/>\n<n d=\"0 0 1\"/>\n<n d=\"0 0 1\"/>\n</f>\n"
    "<f v=\"0 2 3\" fn=\"0 0 1\">\n<n d=\"0 0 1\"/>\n<n d=\"0 0 1\"/>\n<n d=\"0 0 1\"/>\n</f>\n"
    "</facets>\n";

inline std::string shell(const std::string& content, const std::string& id = "id3") {
  return "<shell id=\"" + id + "\" color=\"959595\">\n" + content + "</shell>\n";
}

/// A document with one product and one shape, both of them using the shells given; line 5 is the first after
/// them.
inline std::string document(const std::string& shells, const std::string& shell_ids = "id3") {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<step-assembly root=\"id1\">\n"
         "<product id=\"id1\" name=\"T\" shape=\"id2\"/>\n"
         "<shape id=\"id2\" unit=\"mm 0.001000\" shell=\"" +
         shell_ids + "\"/>\n" + shells + "</step-assembly>\n";
}

inline std::string square() {
  return document(shell(kPoints + kSquare));
}

inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  return at == text.npos ? "the text to replace is absent" : text.replace(at, from.size(), to);
}

inline Model read(std::string_view text, const ReadOptions& options = {}) {
  return read_model(text, "m.xml", options);
}

/// Everything but the diagnostics, bit by bit, as text; for comparison.
inline std::string fingerprint(const Model& model) {
  std::string out = model.name + ' ' + std::to_string(model.metres_per_unit);
  const auto bytes = [&](const auto& list) {
    out += '|' + std::to_string(list.size()) + ':';
    if (!list.empty()) out.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof list[0]);
  };
  for (const Shell& shell : model.shells) {
    out += '\n' + shell.id +
           std::to_string(shell.color.red * 65536 + shell.color.green * 256 + shell.color.blue);
    bytes(shell.points);
    bytes(shell.triangles);
    bytes(shell.corner_normals);
    for (const Patch& patch : shell.patches) {
      out += '\n' + patch.name + std::to_string(patch.first_triangle) + ' ' +
             std::to_string(patch.triangle_count) + ' ' +
             std::to_string(patch.color.red * 65536 + patch.color.green * 256 + patch.color.blue);
    }
  }
  for (const Instance& instance : model.instances) {
    out += '\n' + std::to_string(instance.shell) + instance.path;
    out.append(reinterpret_cast<const char*>(instance.placement.data()), 16 * sizeof(double));
  }
  for (const Polyline& line : model.annotations) {
    out += '\n' + line.name;
    bytes(line.points);
  }
  return out;
}

inline std::string texts(const std::vector<Diagnostic>& diagnostics) {
  std::string out;
  for (const Diagnostic& diagnostic : diagnostics) out += diagnostic.text() + '\n';
  return out;
}

}  // namespace webxml_text

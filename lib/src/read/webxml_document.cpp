#include "read/webxml_document.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "base/text_cursor.hpp"
#include "read/xml_words.hpp"

namespace meshcontour::detail {
namespace {

using tinyxml2::XMLElement;

constexpr double kLargestMatrixEntry = kUsualCoordinate;

class DocumentReader {
 public:
  DocumentReader(WebxmlOutline& outline, const std::string& file, Findings& findings)
      : outline_(outline), file_(file), findings_(findings) {}

  WebxmlDocument run() {
    tinyxml2::XMLDocument tree;
    parse_digest(tree, outline_.digest, file_);
    const XMLElement& root = *tree.RootElement();
    document_.root_element = root.Name();
    if (document_.root_element == "shell") {
      read_shell(root);
    } else if (document_.root_element == "annotation") {
      read_annotation(root);
    } else {
      if (root.Attribute("root") != nullptr) document_.roots = references(root, "root");
      for (const XMLElement* e = root.FirstChildElement(); e != nullptr; e = e->NextSiblingElement())
        read_element(*e);
    }
    return std::move(document_);
  }

 private:
  void read_element(const XMLElement& element) {
    const std::string_view name = element.Name();
    if (name == "product") return read_product(element);
    if (name == "shape") return read_shape(element);
    if (name == "shell") return read_shell(element);
    if (name == "annotation") return read_annotation(element);
    report_unexpected(element);
  }

  void read_product(const XMLElement& element) {
    document_.products.push_back({text(element, "id"), text(element, "name"), references(element, "shape"),
                                  references(element, "children")});
    check_id(element);
  }

  void read_shape(const XMLElement& element) {
    WebxmlShape shape{text(element, "id"),
                      text(element, "unit"),
                      references(element, "shell"),
                      references(element, "annotation"),
                      {},
                      element.GetLineNum()};
    check_id(element);
    for (const XMLElement* e = element.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      if (std::string_view(e->Name()) != "child") {
        report_unexpected(*e);
      } else if (e->Attribute("ref") == nullptr) {
        warn("child", *e, "a child without ref is left out");
      } else {
        shape.children.push_back({text(*e, "ref"), placement(*e), e->GetLineNum()});
      }
    }
    document_.shapes.push_back(std::move(shape));
  }

  void read_shell(const XMLElement& element) {
    WebxmlShell shell{text(element, "id"), color(element), href(element), {}, {}, element.GetLineNum()};
    check_id(element);
    for (const XMLElement* e = element.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const std::string_view name = e->Name();
      if (name == "facets") {
        shell.facets.push_back({color(*e), body(*e)});
      } else if (name == "verts") {
        if (shell.vertices) fail(*e, "a second <verts> in one shell");
        shell.vertices = body(*e);
      } else {
        report_unexpected(*e);
      }
    }
    document_.shells.push_back(std::move(shell));
  }

  void read_annotation(const XMLElement& element) {
    WebxmlAnnotation annotation{text(element, "id"), href(element), {}, element.GetLineNum()};
    check_id(element);
    for (const XMLElement* e = element.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      if (std::string_view(e->Name()) != "polyline") {
        report_unexpected(*e);
      } else if (const auto number = body(*e)) {
        annotation.polylines.push_back(*number);
      }
    }
    document_.annotations.push_back(std::move(annotation));
  }

  std::optional<Eigen::Affine3d> placement(const XMLElement& child) {
    const char* value = child.Attribute("xform");
    if (value == nullptr) {
      warn("no xform", child, "a child without xform is placed as it is");
      return Eigen::Affine3d::Identity();
    }
    const auto words = xml_words(value);
    if (words.size() != 16) fail(child, fmt::format("xform needs 16 numbers, found {}", words.size()));
    Eigen::Matrix4d matrix;  // column major, as the file has it
    for (std::size_t k = 0; k < 16; ++k) {
      const auto number = parse_number(words[k]);
      if (!number) fail(child, fmt::format("xform: '{}' is not a finite number", printable(words[k], 40)));
      matrix(static_cast<Eigen::Index>(k)) = *number;
    }
    if (const auto wrong = unusable(matrix); !wrong.empty()) {
      warn("xform", child, fmt::format("{}: this child is left out", wrong));
      return std::nullopt;
    }
    return Eigen::Affine3d(matrix);
  }

  static std::string_view unusable(const Eigen::Matrix4d& matrix) {
    if (matrix.cwiseAbs().maxCoeff() > kLargestMatrixEntry) return "xform has entries beyond 1e15";
    if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
      return "xform is no placement in columns (its 4th, 8th, 12th and 16th number must be 0 0 0 1)";
    }
    const Eigen::Matrix3d linear = matrix.topLeftCorner<3, 3>();
    const double size = linear.cwiseAbs().maxCoeff();
    if (!(std::abs((linear / size).determinant()) > 1e-12)) return "xform collapses its part";
    return {};
  }

  std::optional<Rgba> color(const XMLElement& element) {
    const char* value = element.Attribute("color");
    if (value == nullptr) return std::nullopt;
    const std::string_view digits = value;
    std::uint32_t rgb = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), rgb, 16);
    if (digits.size() == 6 && error == std::errc() && end == digits.data() + 6) {
      return Rgba{static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8 & 0xFF),
                  static_cast<std::uint8_t>(rgb & 0xFF), 0xFF};
    }
    warn("color", element, fmt::format("color '{}' is not rrggbb and is not used", printable(digits, 40)));
    return std::nullopt;
  }

  static std::optional<std::string> href(const XMLElement& element) {
    const char* value = element.Attribute("href");
    return value == nullptr ? std::nullopt : std::optional<std::string>(value);
  }

  // The number that stands for a body, if the element has one.
  static std::optional<std::size_t> body(const XMLElement& element) {
    const char* number = element.GetText();
    return number == nullptr ? std::nullopt : parse_integer<std::size_t>(xml_words(number).front());
  }

  WebxmlReferences references(const XMLElement& element, const char* attribute) {
    WebxmlReferences found{{}, element.GetLineNum()};
    const char* value = element.Attribute(attribute);
    if (value == nullptr) return found;
    for (const std::string_view id : xml_words(value)) found.ids.emplace_back(id);
    return found;
  }

  static std::string text(const XMLElement& element, const char* attribute) {
    const char* value = element.Attribute(attribute);
    return value == nullptr ? std::string() : std::string(value);
  }

  void check_id(const XMLElement& element) {
    if (!text(element, "id").empty()) return;
    warn("id", element, fmt::format("<{}> has no id: nothing can refer to it", element.Name()));
  }

  void report_unexpected(const XMLElement& element) {
    warn("element", element, "does not belong here and is left out");
  }

  void warn(std::string_view kind, const XMLElement& element, const std::string& message) {
    findings_.warn(kind, [&] { return std::pair(message, spot(element)); });
  }

  // Only for messages: it may have to count the lines of the whole file.
  Spot spot(const XMLElement& element) {
    const std::string name = element_text(element.Name(), text(element, "id"));
    return {file_, outline_.digest.line(element.GetLineNum()), 0, name};
  }

  [[noreturn]] void fail(const XMLElement& element, const std::string& message) {
    throw Error(ErrorCode::BadData, message, spot(element));
  }

  WebxmlOutline& outline_;
  const std::string& file_;
  Findings& findings_;
  WebxmlDocument document_;
};

}  // namespace

std::string element_text(std::string_view name, std::string_view id) {
  return printable(name, 40) + (id.empty() ? "" : " ") + printable(id, 80);
}

WebxmlDocument read_document(WebxmlOutline& outline, const std::string& file, Findings& findings) {
  return DocumentReader(outline, file, findings).run();
}

}  // namespace meshcontour::detail

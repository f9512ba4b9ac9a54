#include "meshcontour/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "meshcontour/cleaning.hpp"
#include "read/findings.hpp"
#include "read/format.hpp"

namespace meshcontour {

using namespace detail;

namespace {

void warn_of_flat_shells(Model& model, const std::string& file) {
  Findings findings;
  for (const Shell& shell : model.shells) {
    if (shell.triangles.empty() || has_area(shell)) continue;
    findings.warn("flat", [&] {
      return std::pair("no triangle of the shell has an area, as if all its points lay on a line",
                       Spot{file, 0, 0, "shell " + printable(shell.id, 80)});
    });
  }
  model.diagnostics.insert(model.diagnostics.end(), findings.diagnostics().begin(),
                           findings.diagnostics().end());
}

constexpr double kLargest = 1e101;        // volumes stay finite; sweeps add curves of up to 1e100
constexpr double kLargestPlaced = 1e150;  // areas do

bool in_range(const Box& box, double largest) {
  return box.isEmpty() || ((box.min().array() >= -largest).all() && (box.max().array() <= largest).all());
}

[[noreturn]] void refuse_vertex(const Shell& shell, const std::string& file) {
  const auto beyond = [](const Point& p) { return !(p.cwiseAbs().maxCoeff() <= kLargest); };
  const auto found = std::ranges::find_if(shell.points, beyond);
  throw Error(ErrorCode::BadData,
              fmt::format("vertex {} has the coordinate {}, the limit is {}", found - shell.points.begin(),
                          found->cwiseAbs().maxCoeff(), kLargest),
              {file, 0, 0, "shell " + printable(shell.id, 80)});
}

void check_range(const Model& model, const std::string& file) {
  std::vector<Box> boxes;
  for (const Shell& shell : model.shells) {
    Box& box = boxes.emplace_back();
    for (const Point& p : shell.points) box.extend(p);
    if (!in_range(box, kLargest)) refuse_vertex(shell, file);
  }
  for (const Instance& instance : model.instances) {
    if (boxes[instance.shell].isEmpty() ||
        in_range(boxes[instance.shell].transformed(instance.placement), kLargestPlaced)) {
      continue;
    }
    throw Error(ErrorCode::BadData,
                fmt::format("a part is placed beyond {}, the limit of coordinates", kLargestPlaced),
                {file, 0, 0, "shell " + printable(model.shells[instance.shell].id, 80)});
  }
  for (const Polyline& line : model.annotations) {
    Box box;
    for (const Point& p : line.points) box.extend(p);
    if (!in_range(box, kLargestPlaced)) {
      throw Error(ErrorCode::BadData,
                  fmt::format("it lies beyond {}, the limit of coordinates", kLargestPlaced),
                  {file, 0, 0, "annotation " + printable(line.name, 80)});
    }
  }
}

Model checked(Model model, const ReadContext& context) {
  validate(model);
  check_range(model, context.name);
  warn_of_flat_shells(model, context.name);
  if (context.options.strict) {
    for (const Diagnostic& diagnostic : model.diagnostics) {
      if (diagnostic.severity == Diagnostic::Severity::Warning) {
        throw Error(ErrorCode::BadData, diagnostic.message, diagnostic.spot);
      }
    }
  }
  if (model.name.empty()) model.name = std::filesystem::path(context.name).stem().string();
  return model;
}

}  // namespace

std::vector<std::string> readable_extensions() {
  std::vector<std::string> out;
  for (const Format& format : formats())
    out.insert(out.end(), format.extensions.begin(), format.extensions.end());
  return out;
}

Model read_model(const std::filesystem::path& file, const ReadOptions& options) {
  InputFile input(file);
  const Format& format = detect_format(input.head(), input.size(), input.name(), formats());
  std::optional<InputFolder> folder;
  if (!input.is_descriptor()) folder.emplace(file.parent_path());
  const ReadContext context{input.name(), options, folder ? &*folder : nullptr};
  if (format.read_file != nullptr && input.size() > 0)
    return checked(format.read_file(input, context), context);
  const FileBytes bytes = input.read();
  return checked(format.read(bytes.view(), context), context);
}

Model read_model(std::string_view bytes, std::string_view name, const ReadOptions& options) {
  const Format& format = detect_format(bytes.substr(0, 4096), bytes.size(), name, formats());
  const ReadContext context{std::string(name), options};
  return checked(format.read(bytes, context), context);
}

}  // namespace meshcontour

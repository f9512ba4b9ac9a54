#include "meshcontour/read.hpp"

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

Model checked(Model model, const ReadContext& context) {
  validate(model);
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

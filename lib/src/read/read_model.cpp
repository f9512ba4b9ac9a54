#include "meshcontour/read.hpp"

#include <optional>

#include "read/format.hpp"

namespace meshcontour {

using namespace detail;

namespace {

Model checked(Model model, const ReadContext& context) {
  if (context.options.strict) {
    for (const Diagnostic& diagnostic : model.diagnostics) {
      if (diagnostic.severity == Diagnostic::Severity::Warning) {
        throw Error(ErrorCode::BadData, diagnostic.message, diagnostic.spot);
      }
    }
  }
  if (model.name.empty()) model.name = std::filesystem::path(context.name).stem().string();
  validate(model);
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

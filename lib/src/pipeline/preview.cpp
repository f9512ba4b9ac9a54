#include "pipeline/preview.hpp"

#include <fmt/format.h>

#include "base/base64.hpp"
#include "meshcontour/output.hpp"
#include "write/png.hpp"

namespace meshcontour::detail {
namespace {

constexpr int kWidth = 320, kHeight = 240;  // pixels

std::string picture(const Job& job, Run& run) try {
  RenderOptions options = job.render;
  options.width = kWidth;
  options.height = kHeight;
  const std::vector<std::uint8_t> png = encode_png(render(run.model, run.boundaries, run.contours, options));
  return base64({reinterpret_cast<const char*>(png.data()), png.size()});
} catch (const Error& error) {
  run.diagnostics.push_back(
      {Diagnostic::Severity::Note, fmt::format("the page has no picture: {}", error.what()), {}});
  return {};
}

// The indices alone, without making the file.
std::uint64_t least_glb_size(const Model& model) {
  std::vector<bool> placed(model.shells.size(), false);
  std::uint64_t size = 0;
  for (const Instance& instance : model.instances) {
    if (!placed[instance.shell]) size += sizeof(Triangle) * model.shells[instance.shell].triangles.size();
    placed[instance.shell] = true;
  }
  return size;
}

}  // namespace

Preview make_preview(const Job& job, Run& run) {
  Preview preview;
  preview.picture = picture(job, run);
  preview.model_size = least_glb_size(run.model);
  if (preview.model_size > kLargestPreviewModel) return preview;
  WriteOptions options = job.write;
  options.edges = EdgeUse::Unique;
  StringSink glb;
  std::vector<Diagnostic> notes;
  try {
    write_output(OutputFormat::Glb, {run.model, run.boundaries, run.contours}, options, glb, notes);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::BadData) throw;
    run.diagnostics.push_back(
        {Diagnostic::Severity::Note, fmt::format("the page has no model: {}", error.what()), {}});
    return preview;
  }
  preview.model_size = glb.text.size();
  if (preview.model_size <= kLargestPreviewModel) preview.model = base64(glb.text);
  return preview;
}

}  // namespace meshcontour::detail

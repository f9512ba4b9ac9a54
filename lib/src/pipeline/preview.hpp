#pragma once

#include "meshcontour/pipeline.hpp"

namespace meshcontour::detail {

/// A small picture of the job's layers and view, and the model as GLB. Without a renderer the picture is
/// missing, which is noted in run.diagnostics.
Preview make_preview(const Job& job, Run& run);

}  // namespace meshcontour::detail

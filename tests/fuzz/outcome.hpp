#pragma once

// What a reader makes of an input, for the targets that read models.

#include <string>

#include "fuzz/targets.hpp"
#include "meshcontour/read.hpp"
#include "unit/read/webxml_text.hpp"

namespace fuzz {

inline std::string_view text_of(Bytes input) {
  return {reinterpret_cast<const char*>(input.data()), input.size()};
}

/// The model bit by bit with what was said of it, or that the reader refuses it. Of several faults two ways
/// of reading may name either.
template <typename Read>
std::string outcome(const Read& read) {
  try {
    const meshcontour::Model model = read();
    validate(model);
    return webxml_text::fingerprint(model) + webxml_text::texts(model.diagnostics);
  } catch (const meshcontour::Error& error) {
    require(error.code() != meshcontour::ErrorCode::Internal, error.what());
    return "refused";
  }
}

}  // namespace fuzz

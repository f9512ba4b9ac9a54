#include "read/wavelet.hpp"

#include "meshcontour/wavelet_stream.hpp"

namespace meshcontour::detail {

Match sniff_wavelet(std::string_view head, std::uint64_t) {
  return is_wavelet_stream(head) ? Match::Sure : Match::No;
}

Model read_wavelet(std::string_view bytes, const ReadContext& context) {
  return read_wavelet_stream(bytes, context.name, context.options.max_triangles, context.options.threads);
}

}  // namespace meshcontour::detail

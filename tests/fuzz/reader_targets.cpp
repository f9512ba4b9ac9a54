// Every reader either gives a model that keeps the promises of validate(), or an Error.

#include <string>

#include "fuzz/outcome.hpp"
#include "fuzz/targets.hpp"
#include "meshcontour/mesh_write.hpp"
#include "meshcontour/output.hpp"
#include "meshcontour/read.hpp"
#include "multires/stream_blocks.hpp"
#include "read/webxml.hpp"

namespace fuzz {
namespace {

using namespace meshcontour;

ReadOptions limits() {
  ReadOptions options;
  options.max_triangles = 20'000;
  options.max_instances = 1'000;
  options.sweep.max_frames = 1'000;
  options.threads = 1;
  return options;
}

void read_named(Bytes input, const char* name) {
  const ReadOptions options = limits();
  outcome([&] { return read_model(text_of(input), name, options); });
}

}  // namespace

void read_webxml_both_ways(Bytes input) {
  const ReadOptions options = limits();
  const detail::ReadContext context{"m.xml", options};
  const std::string scanned = outcome([&] { return detail::read_webxml(text_of(input), context); });
  const std::string parsed = outcome([&] { return detail::read_webxml_carefully(text_of(input), context); });
  require(scanned == parsed,
          "the two ways of reading differ:\n" + scanned.substr(0, 400) + "\n" + parsed.substr(0, 400));
}

void read_swp(Bytes input) {
  read_named(input, "m.swp");
}

void read_stl(Bytes input) {
  read_named(input, "m.stl");
}

void read_obj(Bytes input) {
  read_named(input, "m.obj");
}

void read_ply(Bytes input) {
  read_named(input, "m.ply");
}

void read_off(Bytes input) {
  read_named(input, "m.off");
}

// What was read is written and read again: the same, and written the same.
void read_net(Bytes input) {
  const ReadOptions options = limits();
  const auto written = [&](std::string_view text) {
    StringSink sink;
    std::vector<Diagnostic> notes;
    write_mesh(MeshFormat::Net, read_model(text, "m.net", options), {}, sink, notes);
    return sink.text;
  };
  try {
    const std::string once = written(text_of(input));
    require(written(once) == once, "a control mesh changes when it is written and read again");
  } catch (const Error& error) {
    require(error.code() != ErrorCode::Internal, error.what());
  }
}

// The blocks of a stream before they are compressed, each behind its kind and a length of two bytes, as no
// mutation gets past compression and checksums. An input that begins like a stream is taken as it is.
void read_wavelet(Bytes input) {
  std::string_view rest = text_of(input);
  if (rest.starts_with(detail::kStreamSignature)) return read_named(input, "m.mcw");
  StringSink stream;
  detail::BlockWriter blocks(stream);
  while (rest.size() >= 3) {
    const auto kind = static_cast<detail::BlockKind>(rest[0]);
    if (kind == detail::BlockKind::End) blocks.end();
    const std::size_t size = static_cast<std::uint8_t>(rest[1]) + 256u * static_cast<std::uint8_t>(rest[2]);
    rest.remove_prefix(3);
    blocks.write(kind, rest.substr(0, size));
    rest.remove_prefix(std::min(size, rest.size()));
  }
  read_named({reinterpret_cast<const std::uint8_t*>(stream.text.data()), stream.text.size()}, "m.mcw");
}

}  // namespace fuzz

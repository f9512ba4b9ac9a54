#include "multires/stream_blocks.hpp"

#include <fmt/format.h>
#include <zstd.h>

#include <memory>

namespace meshcontour::detail {
namespace {

constexpr int kCompression = 19;
constexpr std::size_t kHeadSize = 5;  // kind and length

// Each part gets statistics of its own.
std::string compressed(std::span<const std::string_view> parts) {
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), ZSTD_freeCCtx);
  if (!context) throw Error(ErrorCode::OutOfMemory, "wavelet stream: no memory to compress");
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kCompression);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  std::string out;
  for (const std::string_view& part : parts) {
    const ZSTD_EndDirective directive = &part == &parts.back() ? ZSTD_e_end : ZSTD_e_flush;
    ZSTD_inBuffer input{part.data(), part.size(), 0};
    for (std::size_t rest = 1; rest > 0;) {
      const std::size_t begin = out.size();
      out.resize(begin + ZSTD_CStreamOutSize());
      ZSTD_outBuffer output{out.data() + begin, out.size() - begin, 0};
      rest = ZSTD_compressStream2(context.get(), &output, &input, directive);
      if (ZSTD_isError(rest))
        throw Error(ErrorCode::Internal, std::string("zstd: ") + ZSTD_getErrorName(rest));
      out.resize(begin + output.pos);
    }
  }
  return out;
}

}  // namespace

BlockWriter::BlockWriter(Sink& sink) : sink_(sink) {
  sink_.write(kStreamSignature);
  sink_.write({reinterpret_cast<const char*>(&kStreamVersion), 1});
}

void BlockWriter::write(BlockKind kind, std::string_view bytes) {
  for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), kLargestBlock))) {
    const std::string_view part = bytes.substr(0, kLargestBlock);
    write(kind, std::span(&part, 1));
  }
}

void BlockWriter::write(BlockKind kind, std::span<const std::string_view> parts) {
  const std::string block = compressed(parts);
  ByteWriter head;
  head.byte(static_cast<std::uint8_t>(kind));
  head.fixed(block.size(), 4);
  sink_.write(head.bytes());
  sink_.write(block);
}

void BlockWriter::end() {
  ByteWriter head;
  head.byte(static_cast<std::uint8_t>(BlockKind::End));
  head.fixed(0, 4);
  sink_.write(head.bytes());
}

BlockReader::BlockReader(std::string_view bytes, std::string_view name) : in_(bytes, name) {
  if (!bytes.starts_with(kStreamSignature)) in_.fail("it does not begin as one");
  in_.take(kStreamSignature.size());
  const std::uint64_t version = in_.fixed(1);
  if (version != kStreamVersion) in_.fail(fmt::format("version {}, known is {}", version, kStreamVersion));
}

std::optional<Block> BlockReader::next() {
  if (in_.remaining() < kHeadSize) return std::nullopt;
  ByteReader ahead = in_;
  ++number_;
  const std::uint64_t kind = ahead.fixed(1), size = ahead.fixed(4);
  Block block;
  if (kind == static_cast<std::uint8_t>(BlockKind::End)) {
    if (size != 0 || ahead.remaining() > 0) in_.fail("bytes follow its end");
    return block;
  }
  if (kind != static_cast<std::uint8_t>(BlockKind::Base) &&
      kind != static_cast<std::uint8_t>(BlockKind::Details)) {
    in_.fail(fmt::format("block {} is of the unknown kind {}", number_, kind));
  }
  if (size > ZSTD_compressBound(kLargestBlock)) in_.fail(fmt::format("block {} is too large", number_));
  if (size > ahead.remaining()) return std::nullopt;
  const std::string_view stored = ahead.take(size);
  block.kind = static_cast<BlockKind>(kind);
  block.bytes.resize(kLargestBlock);
  const std::size_t length =
      ZSTD_decompress(block.bytes.data(), block.bytes.size(), stored.data(), stored.size());
  if (ZSTD_isError(length))
    in_.fail(fmt::format("block {} is damaged ({})", number_, ZSTD_getErrorName(length)));
  block.bytes.resize(length);
  in_ = ahead;
  return block;
}

}  // namespace meshcontour::detail

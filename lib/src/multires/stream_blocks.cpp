#include "multires/stream_blocks.hpp"

#include <fmt/format.h>
#include <zstd.h>

namespace meshcontour::detail {
namespace {

constexpr int kCompression = 19, kFastCompression = 9;
constexpr std::size_t kThorough = std::size_t{1} << 20;  // bytes; what comes behind them is compressed fast
constexpr std::size_t kHeadSize = 5;                     // kind and length

void check(std::size_t result) {
  if (ZSTD_isError(result))
    throw Error(ErrorCode::Internal, std::string("zstd: ") + ZSTD_getErrorName(result));
}

}  // namespace

// One for all blocks: making one costs far more than most blocks do.
struct BlockWriter::Compressor {
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context{ZSTD_createCCtx(), ZSTD_freeCCtx};

  Compressor() {
    if (!context) throw Error(ErrorCode::OutOfMemory, "wavelet stream: no memory to compress");
    check(ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1));
  }

  // Each part gets statistics of its own.
  std::string compressed(std::span<const std::string_view> parts, int level) const {
    std::size_t size = 0;
    for (const std::string_view& part : parts) size += part.size();
    check(ZSTD_CCtx_reset(context.get(), ZSTD_reset_session_only));
    check(ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level));
    check(ZSTD_CCtx_setPledgedSrcSize(context.get(), size));  // tables no larger than the block needs
    std::string out;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      append(parts[i], i + 1 == parts.size() ? ZSTD_e_end : ZSTD_e_flush, out);
    }
    return out;
  }

  void append(std::string_view part, ZSTD_EndDirective directive, std::string& out) const {
    ZSTD_inBuffer input{part.data(), part.size(), 0};
    for (std::size_t rest = 1; rest > 0;) {
      const std::size_t begin = out.size();
      out.resize(begin + ZSTD_CStreamOutSize());
      ZSTD_outBuffer output{out.data() + begin, out.size() - begin, 0};
      rest = ZSTD_compressStream2(context.get(), &output, &input, directive);
      check(rest);
      out.resize(begin + output.pos);
    }
  }
};

BlockWriter::BlockWriter(Sink& sink) : sink_(sink), compressor_(std::make_unique<Compressor>()) {
  sink_.write(kStreamSignature);
  sink_.write({reinterpret_cast<const char*>(&kStreamVersion), 1});
}

BlockWriter::~BlockWriter() = default;

void BlockWriter::write(BlockKind kind, std::string_view bytes) {
  for (std::size_t begin = 0; begin < bytes.size(); begin += kLargestBlock) {
    const std::string_view part = bytes.substr(begin, kLargestBlock);
    const int level = begin < kThorough ? kCompression : kFastCompression;
    put(kind, compressor_->compressed(std::span(&part, 1), level));
  }
}

void BlockWriter::write(BlockKind kind, std::span<const std::string_view> parts) {
  put(kind, compressor_->compressed(parts, kCompression));
}

void BlockWriter::put(BlockKind kind, std::string_view block) {
  ByteWriter head;
  head.byte(static_cast<std::uint8_t>(kind));
  head.fixed(block.size(), 4);
  sink_.write(head.bytes());
  sink_.write(block);
}

void BlockWriter::end() {
  put(BlockKind::End, {});
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
  block.kind = static_cast<BlockKind>(kind);
  block.bytes = decompressed(ahead.take(size));
  in_ = ahead;
  return block;
}

std::string BlockReader::decompressed(std::string_view stored) const {
  std::string bytes(kLargestBlock, '\0');
  const std::size_t length = ZSTD_decompress(bytes.data(), bytes.size(), stored.data(), stored.size());
  if (ZSTD_isError(length))
    in_.fail(fmt::format("block {} is damaged ({})", number_, ZSTD_getErrorName(length)));
  bytes.resize(length);
  return bytes;
}

}  // namespace meshcontour::detail

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "meshcontour/output.hpp"
#include "multires/stream_bytes.hpp"

namespace meshcontour::detail {

/// The frame of a wavelet stream: a signature, a version, then blocks of a kind, the length of their
/// compressed bytes and these: a zstd frame with its checksum. The end block has none.
inline constexpr std::string_view kStreamSignature = "\x8FMCWAVE\n";
inline constexpr std::uint8_t kStreamVersion = 2;

/// The step of the details of a level, beside that of the finest: halved from level to level, as fewer
/// details move larger parts of the surface.
constexpr double detail_step(double finest, unsigned level, unsigned levels) {
  return finest / static_cast<double>(std::uint64_t{1} << (levels - 1 - level));
}

enum class BlockKind : std::uint8_t { Base = 'B', Details = 'D', End = 'E' };

/// No block is larger before compression.
inline constexpr std::size_t kLargestBlock = std::size_t{1} << 18;

/// Writes a stream block by block.
class BlockWriter {
 public:
  /// Writes signature and version.
  explicit BlockWriter(Sink& sink);
  ~BlockWriter();

  /// Writes bytes as blocks of one kind, cut where they are too many for one; after a million less
  /// thoroughly packed, which takes a small part of the time.
  void write(BlockKind kind, std::string_view bytes);

  /// Writes parts, together no larger than the largest block, as one block.
  void write(BlockKind kind, std::span<const std::string_view> parts);

  /// Writes the end block, behind which nothing may follow.
  void end();

 private:
  struct Compressor;
  void put(BlockKind kind, std::string_view block);

  Sink& sink_;
  std::unique_ptr<Compressor> compressor_;
};

/// A block as it was before compression.
struct Block {
  BlockKind kind = BlockKind::End;
  std::string bytes;
};

/// Takes a stream apart. Its errors name the stream and the block's number.
class BlockReader {
 public:
  /// @param bytes  of the stream or its beginning; outlive this.
  /// @param name   of the stream, for messages.
  /// @throws Error  BadData if signature or version are wrong.
  BlockReader(std::string_view bytes, std::string_view name);

  /// The next block, nothing where the bytes end in or before it.
  ///
  /// @throws Error  BadData if it is damaged, or something follows the end block.
  std::optional<Block> next();

 private:
  std::string decompressed(std::string_view stored) const;

  ByteReader in_;
  std::size_t number_ = 0;  // of the last block, from 1
};

}  // namespace meshcontour::detail

#include "model/point_numbering.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "base/large_array.hpp"
#include "meshcontour/error.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::size_t kBatch = 256;
constexpr std::size_t kLeastSlots = 1024;
constexpr std::size_t kLongestProbe = 200;  // at half load a good hash stays far below
constexpr std::uint64_t kSeeds = 8;

// Adding zero makes -0 to 0.
std::uint64_t bits(double coordinate, std::uint64_t seed) {
  return std::bit_cast<std::uint64_t>(coordinate + 0.0) ^ seed;
}

}  // namespace

PointNumbering::PointNumbering(std::size_t expected) {
  reserve_large(points_, expected);
  rehash(std::max(kLeastSlots, std::bit_ceil(2 * expected)), 0);
}

std::uint64_t PointNumbering::hash(const Point& point) const {
  const std::uint64_t seed = seed_ * 0xD6E8FEB86659FD93;
  const std::uint64_t x = bits(point.x(), seed) * 0x9E3779B97F4A7C15;
  const std::uint64_t y = bits(point.y(), seed) * 0xA0761D6478BD642F;
  const std::uint64_t z = bits(point.z(), seed) * 0xE7037ED1A0B428DB;
  const std::uint64_t mixed = x ^ std::rotl(y, 23) ^ std::rotl(z, 46);
  return (mixed ^ mixed >> 32) * 0x8EBC6AF09C88C6E3;
}

void PointNumbering::rehash(std::size_t capacity, std::uint64_t seed) {
  seed_ = seed;
  shift_ = 64 - std::countr_zero(capacity);
  assign_large(slots_, capacity, Slot{});
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const std::uint64_t h = hash(points_[i]);
    std::size_t place = home(h);
    while (slots_[place].number != kEmpty) place = (place + 1) & (capacity - 1);
    slots_[place] = {static_cast<std::uint32_t>(h), static_cast<Index>(i)};
  }
}

Index PointNumbering::add_hashed(const Point& point, std::uint64_t hash) {
  const auto tag = static_cast<std::uint32_t>(hash);
  std::size_t place = home(hash), probes = 0;
  for (; slots_[place].number != kEmpty; place = (place + 1) & (slots_.size() - 1), ++probes) {
    if (slots_[place].tag == tag && points_[slots_[place].number] == point) return slots_[place].number;
  }
  if (points_.size() >= kEmpty - 1) throw Error(ErrorCode::OutOfMemory, "more points than can be numbered");
  const auto number = static_cast<Index>(points_.size());
  slots_[place] = {tag, number};
  points_.push_back(point + Point::Zero());
  if (2 * points_.size() > slots_.size()) rehash(2 * slots_.size(), seed_);
  if (probes > kLongestProbe && seed_ < kSeeds) rehash(slots_.size(), seed_ + 1);
  return number;
}

void PointNumbering::add_batch(std::span<const Point> batch, std::span<Index> numbers) {
  std::array<std::uint64_t, kBatch> hashes;
  const std::uint64_t seed = seed_;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    hashes[i] = hash(batch[i]);
    __builtin_prefetch(&slots_[home(hashes[i])]);
  }
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const Slot& slot = slots_[home(hashes[i])];
    if (slot.number != kEmpty) __builtin_prefetch(&points_[slot.number]);
  }
  for (std::size_t i = 0; i < batch.size(); ++i) {
    numbers[i] = add_hashed(batch[i], seed == seed_ ? hashes[i] : hash(batch[i]));
  }
}

void PointNumbering::add(std::span<const Point> batch, std::span<Index> numbers) {
  for (std::size_t i = 0; i < batch.size(); i += kBatch) {
    const std::size_t size = std::min(kBatch, batch.size() - i);
    add_batch(batch.subspan(i, size), numbers.subspan(i, size));
  }
}

std::optional<Index> PointNumbering::find(const Point& point) const {
  const std::uint64_t h = hash(point);
  for (std::size_t place = home(h);; place = (place + 1) & (slots_.size() - 1)) {
    const Slot& slot = slots_[place];
    if (slot.number == kEmpty) return std::nullopt;
    if (slot.tag == static_cast<std::uint32_t>(h) && points_[slot.number] == point) return slot.number;
  }
}

}  // namespace meshcontour::detail

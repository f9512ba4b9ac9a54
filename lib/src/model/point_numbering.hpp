#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "meshcontour/types.hpp"

namespace meshcontour::detail {

/// Numbers points by their first appearance: equal coordinates (0 equals -0) get the same number.
///
/// A flat hash table that is asked in batches, so that its memory is fetched ahead. Long probes, which only a
/// crafted input has, change the hash function; numbers do not depend on it.
class PointNumbering {
 public:
  /// @param expected  different points, for sizing; more is fine.
  explicit PointNumbering(std::size_t expected = 0);

  /// @param numbers  receives one number a point; as long as `batch`.
  /// @throws Error   OutOfMemory when there are more points than an Index can name.
  void add(std::span<const Point> batch, std::span<Index> numbers);

  /// The number of a point that was added.
  std::optional<Index> find(const Point& point) const;

  /// The different points in order of their numbers.
  const std::vector<Point>& points() const { return points_; }
  std::vector<Point> take_points() && { return std::move(points_); }

 private:
  struct Slot {
    std::uint32_t tag = 0;
    Index number = kEmpty;
  };
  static constexpr Index kEmpty = 0xFFFFFFFF;

  std::uint64_t hash(const Point& point) const;
  std::size_t home(std::uint64_t hash) const { return static_cast<std::size_t>(hash >> shift_); }
  Index add_hashed(const Point& point, std::uint64_t hash);
  void rehash(std::size_t capacity, std::uint64_t seed);
  void add_batch(std::span<const Point> batch, std::span<Index> numbers);

  std::vector<Point> points_;
  std::vector<Slot> slots_;  // a power of two
  int shift_ = 0;
  std::uint64_t seed_ = 0;
};

}  // namespace meshcontour::detail

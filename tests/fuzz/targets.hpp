#pragma once

// What the fuzz targets share. A target runs one input and aborts when something is wrong with the program.

#include <cstdint>
#include <span>
#include <string_view>

namespace fuzz {

using Bytes = std::span<const std::uint8_t>;
using Target = void (*)(Bytes);

/// @return  null if there is no target of this name.
Target find_target(std::string_view name);

/// Ends the program with the message, which the fuzzer counts as a finding.
[[noreturn]] void fail(std::string_view message);

inline void require(bool holds, std::string_view message) {
  if (!holds) fail(message);
}

/// Takes numbers off the front of an input; zeros when it is used up.
class Source {
 public:
  explicit Source(Bytes bytes) : bytes_(bytes) {}

  bool empty() const { return bytes_.empty(); }

  std::uint8_t byte() {
    if (bytes_.empty()) return 0;
    const std::uint8_t value = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return value;
  }

  std::uint16_t word() {
    const std::uint16_t low = byte();
    return static_cast<std::uint16_t>(low | byte() << 8);
  }

 private:
  Bytes bytes_;
};

void read_webxml_both_ways(Bytes input);
void read_swp(Bytes input);
void read_stl(Bytes input);
void read_obj(Bytes input);
void read_ply(Bytes input);
void read_off(Bytes input);
void read_net(Bytes input);
void read_wavelet(Bytes input);
void read_files(Bytes input);
void scan_numbers(Bytes input);
void trace_loops(Bytes input);
void fit_loop(Bytes input);
void evaluate_nurbs(Bytes input);

}  // namespace fuzz

#include "meshcontour/cleaning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>

#include "meshcontour/parallel.hpp"

namespace meshcontour {
namespace {

constexpr std::size_t kFewTriangles = 32;  // below, sorting them all is quickest

bool is_degenerate(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

// The same cycle with its lowest vertex first.
Triangle rotated(const Triangle& t) {
  if (t[0] <= t[1] && t[0] <= t[2]) return t;
  return t[1] <= t[2] ? Triangle{t[1], t[2], t[0]} : Triangle{t[2], t[0], t[1]};
}

// splitmix64 [Steele et al. 2014] of all three vertices.
std::uint64_t hash_of(const Triangle& t) {
  std::uint64_t x = (std::uint64_t{t[0]} << 32 | t[1]) + 0x9e3779b97f4a7c15u * (std::uint64_t{t[2]} + 1);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// What is wrong in one patch: triangles to leave out, by their number in the patch, rising.
struct PatchFindings {
  std::vector<std::size_t> dropped;
  std::size_t degenerate = 0, duplicate = 0;
};

// Numbers of triangles that may have a copy: those whose hash meets another one's in a table of 16 bits a
// triangle.
std::vector<std::size_t> candidates(std::span<const Triangle> triangles) {
  std::vector<std::size_t> found;
  const std::size_t bits = std::bit_ceil(triangles.size() * 16);
  std::vector<std::uint64_t> seen(bits / 64), twice(bits / 64);
  for (const Triangle& t : triangles) {
    const std::uint64_t slot = hash_of(rotated(t)) & (bits - 1);
    const std::uint64_t bit = std::uint64_t{1} << (slot % 64);
    twice[slot / 64] |= seen[slot / 64] & bit;
    seen[slot / 64] |= bit;
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::uint64_t slot = hash_of(rotated(triangles[i])) & (bits - 1);
    if ((twice[slot / 64] >> (slot % 64) & 1) != 0) found.push_back(i);
  }
  return found;
}

void find_duplicates(std::span<const Triangle> triangles, PatchFindings& findings) {
  std::vector<std::size_t> suspects;
  if (triangles.size() < kFewTriangles) {
    for (std::size_t i = 0; i < triangles.size(); ++i) suspects.push_back(i);
  } else {
    suspects = candidates(triangles);
  }
  std::ranges::sort(suspects, [&](std::size_t i, std::size_t j) {
    return std::pair(rotated(triangles[i]), i) < std::pair(rotated(triangles[j]), j);
  });
  for (std::size_t k = 1; k < suspects.size(); ++k) {
    const Triangle& t = triangles[suspects[k]];
    if (is_degenerate(t) || rotated(t) != rotated(triangles[suspects[k - 1]])) continue;
    findings.dropped.push_back(suspects[k]);
    ++findings.duplicate;
  }
}

PatchFindings find_in_patch(std::span<const Triangle> triangles) {
  PatchFindings findings;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!is_degenerate(triangles[i])) continue;
    findings.dropped.push_back(i);
    ++findings.degenerate;
  }
  find_duplicates(triangles, findings);
  std::ranges::sort(findings.dropped);
  return findings;
}

void leave_out(Shell& shell, const std::vector<PatchFindings>& findings) {
  std::size_t to = 0;
  for (std::size_t p = 0; p < shell.patches.size(); ++p) {
    Patch& patch = shell.patches[p];
    auto dropped = findings[p].dropped.begin();
    const std::size_t first = to;
    for (std::size_t i = 0; i < patch.triangle_count; ++i) {
      if (dropped != findings[p].dropped.end() && *dropped == i) {
        ++dropped;
        continue;
      }
      const std::size_t from = patch.first_triangle + i;
      shell.triangles[to] = shell.triangles[from];
      for (std::size_t k = 0; k < 3 && !shell.corner_normals.empty(); ++k) {
        shell.corner_normals[3 * to + k] = shell.corner_normals[3 * from + k];
      }
      ++to;
    }
    patch.first_triangle = first;
    patch.triangle_count = to - first;
  }
  shell.triangles.resize(to);
  if (!shell.corner_normals.empty()) shell.corner_normals.resize(3 * to);
}

void report(const Shell& shell, const std::vector<PatchFindings>& findings, std::size_t PatchFindings::*count,
            const char* what, std::vector<Diagnostic>& diagnostics) {
  std::size_t total = 0;
  std::size_t first = 0;
  for (std::size_t p = 0; p < findings.size(); ++p) {
    if (total == 0) first = p;
    total += findings[p].*count;
  }
  if (total == 0) return;
  const std::string where = fmt::format("shell {}, patch {}", printable(shell.id, 80), first + 1);
  diagnostics.push_back({Diagnostic::Severity::Warning, what, Spot{"", 0, 0, where}, total});
}

}  // namespace

std::size_t drop_degenerate_and_duplicate_triangles(Shell& shell, std::vector<Diagnostic>& diagnostics,
                                                    unsigned threads) {
  std::vector<PatchFindings> findings(shell.patches.size());
  parallel_for(findings.size(), 16, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) findings[p] = find_in_patch(shell.patch_triangles(p));
  });
  std::size_t dropped = 0;
  for (const PatchFindings& patch : findings) dropped += patch.dropped.size();
  if (dropped == 0) return 0;
  report(shell, findings, &PatchFindings::degenerate, "a triangle with a repeated vertex is left out",
         diagnostics);
  report(shell, findings, &PatchFindings::duplicate, "a copy of a triangle of the same patch is left out",
         diagnostics);
  leave_out(shell, findings);
  return dropped;
}

}  // namespace meshcontour

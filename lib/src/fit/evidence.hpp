#pragma once

#include <optional>
#include <vector>

#include "fit/piece.hpp"
#include "fit/recognition.hpp"

namespace meshcontour::detail {

/// A run of a path between hard corners, or a whole smooth ring.
struct Run {
  std::size_t begin = 0, end = 0;
  bool ends_hard = true;  ///< false: a ring, cut open at begin
};

/// Marks the pieces of a run for which there is evidence as recognized.
///
/// The first vertex beyond an end of a true arc or line lies far off it, compared to its own residual,
/// because the curvature jumps there; greedy pieces of a free curve fail gently. Equal chords, tangent
/// neighbours, and arcs of the model with the same circle speak for short arcs; a length that no chord of a
/// curve has, for a line.
void judge_pieces(const Path& path, const Run& run, std::vector<Piece>& pieces, double eps,
                  const RecognitionOptions& options);

/// Two chords as one arc, if there is evidence for that.
std::optional<Piece> two_chord_arc(const Path& path, const Run& run, std::size_t begin, double eps,
                                   const RecognitionOptions& options);

/// Whether a curve of this model cannot turn as the path does at the vertex: a joint of two lines.
bool is_coarse_corner(const Path& path, std::size_t vertex, const RecognitionOptions& options);

/// Whether the chord is longer than any chord of a curve with these turnings can be.
bool is_long_chord(const Path& path, const Run& run, std::size_t chord, const RecognitionOptions& options);

}  // namespace meshcontour::detail

// The slots of a disc tree, piece by piece in parallel.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace relief {

/// Slots of a piece: one thread's work at once.
inline constexpr std::size_t kSlotsOfPiece = 512;

/// The number of pieces of `slots` slots.
[[nodiscard]] inline std::size_t count_pieces(std::size_t slots) {
  return (slots + kSlotsOfPiece - 1) / kSlotsOfPiece;
}

/// Calls `work(piece, begin, end)` for each piece, in parallel: its number, and its slots without
/// `end`.
template <class Work>
void for_pieces(std::size_t slots, const Work& work) {
  tbb::parallel_for(std::size_t{0}, count_pieces(slots), [&](std::size_t piece) {
    const std::size_t begin = piece * kSlotsOfPiece;
    work(piece, begin, std::min(begin + kSlotsOfPiece, slots));
  });
}

}  // namespace relief

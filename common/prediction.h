// Predicting an integer on a grid with holes from the neighbours that a decoder already has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace relief {

/// Predicts the value at node (i, j) of a row-major grid from its western and northern neighbours,
/// as far as `kept` marks them: the plane W + N - NW through three of them, otherwise the nearest
/// one; `last` (the value kept last in scan order) where there is none.
template <class Value>
[[nodiscard]] std::int32_t predict(const Value* values, const std::uint8_t* kept, std::size_t width,
                                   std::size_t i, std::size_t j, std::int32_t last) {
  const std::size_t k = j * width + i;
  const bool west = i > 0 && kept[k - 1] != 0;
  const bool north = j > 0 && kept[k - width] != 0;
  const bool north_west = i > 0 && j > 0 && kept[k - width - 1] != 0;
  if (west && north && north_west) return values[k - 1] + values[k - width] - values[k - width - 1];
  if (west) return values[k - 1];
  if (north) return values[k - width];
  if (north_west) return values[k - width - 1];
  if (j > 0 && i + 1 < width && kept[k - width + 1] != 0) return values[k - width + 1];
  return last;
}

}  // namespace relief

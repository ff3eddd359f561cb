#include "common/patch_file/fast/plane_rows.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <utility>
#include <vector>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace relief {
namespace {

/// Stretches are set in blocks of this many nodes; values beyond their ends are ignored.
constexpr std::size_t kBlock = 8;
static_assert(kBlock <= kDifferencePadding);

/// A row of the grid and the one above it, as flags.
struct KeptRows {
  const std::uint8_t* here;
  const std::uint8_t* north;  ///< null in the first row
  std::size_t width;
  std::size_t readable;  ///< bytes from `here` to the end of the grid
};

constexpr bool kReadsWords = std::endian::native == std::endian::little;

std::uint64_t word_at(const std::uint8_t* flags) {
  std::uint64_t word = 0;
  std::memcpy(&word, flags, sizeof(word));
  return word;
}

/// The first flag of a word that is not 0.
std::size_t first_of(std::uint64_t word) {
  return static_cast<std::size_t>(std::countr_zero(word)) / 8;
}

/// The first node from i on that is not kept in both rows, or the row's end. Words may reach into
/// the next row.
std::size_t end_of_stretch(const KeptRows& rows, std::size_t i) {
  for (; kReadsWords && i < rows.width && i + 8 <= rows.readable; i += 8) {
    const std::uint64_t both = word_at(rows.here + i) & word_at(rows.north + i);
    const std::uint64_t missing = both ^ 0x0101010101010101U;
    if (missing != 0) return std::min(i + first_of(missing), rows.width);
  }
  while (i < rows.width && (rows.here[i] & rows.north[i]) != 0) ++i;
  return std::min(i, rows.width);
}

/// The first node from i on that is kept, or the row's end.
std::size_t end_of_holes(const KeptRows& rows, std::size_t i) {
  for (; kReadsWords && i < rows.width && i + 8 <= rows.readable; i += 8) {
    const std::uint64_t here = word_at(rows.here + i);
    if (here != 0) return std::min(i + first_of(here), rows.width);
  }
  while (i < rows.width && rows.here[i] == 0) ++i;
  return std::min(i, rows.width);
}

/// Sets `count` nodes whose western, northern and north-western neighbours are all kept: the
/// difference between a value and its northern neighbour is the sum of all differences so far.
/// `row` and `north` begin at the first of them.
void set_stretch(const std::uint16_t* differences, std::size_t count, const std::uint16_t* north,
                 std::uint16_t* row) {
  auto above = static_cast<std::uint16_t>(row[-1] - north[-1]);
#ifdef __SSE2__
  __m128i sum = _mm_set1_epi16(static_cast<std::int16_t>(above));
  for (std::size_t i = 0; i < count; i += kBlock) {
    __m128i d = _mm_loadu_si128(reinterpret_cast<const __m128i*>(differences + i));
    d = _mm_add_epi16(d, _mm_slli_si128(d, 2));
    d = _mm_add_epi16(d, _mm_slli_si128(d, 4));
    d = _mm_add_epi16(d, _mm_slli_si128(d, 8));
    sum = _mm_add_epi16(sum, d);
    const __m128i n = _mm_loadu_si128(reinterpret_cast<const __m128i*>(north + i));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(row + i), _mm_add_epi16(sum, n));
    sum = _mm_shufflehi_epi16(sum, 0xFF);
    sum = _mm_unpackhi_epi64(sum, sum);
  }
#else
  for (std::size_t i = 0; i < count; ++i) {
    above = static_cast<std::uint16_t>(above + differences[i]);
    row[i] = static_cast<std::uint16_t>(above + north[i]);
  }
#endif
}

/// The neighbours of node i.
Neighbours neighbours_in(const KeptRows& rows, const std::uint16_t* row, const std::uint16_t* north,
                         std::size_t i) {
  Neighbours at;
  at.west = i > 0 && rows.here[i - 1] != 0;
  if (at.west) at.w = row[i - 1];
  if (rows.north == nullptr) return at;
  at.north = rows.north[i] != 0;
  at.north_west = i > 0 && rows.north[i - 1] != 0;
  at.north_east = i + 1 < rows.width && rows.north[i + 1] != 0;
  if (at.north) at.n = north[i];
  if (at.north_west) at.nw = north[i - 1];
  if (at.north_east) at.ne = north[i + 1];
  return at;
}

/// Stores 16-bit values; returns whether a kept one is 65535. Without branches, and of all rows at
/// once: compilers make SIMD of it.
bool store(std::span<const std::uint8_t> kept, const std::uint16_t* from, std::int32_t hole,
           std::int32_t* __restrict to) {
  std::int32_t next_values = 0;  // Bit 16 is set only for 65535 + 1.
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const std::int32_t keep = -std::int32_t{kept[k]};
    const std::int32_t value = from[k] & keep;
    to[k] = value | (hole & ~keep);
    next_values |= value + 1;
  }
  return (next_values & 0x10000) != 0;
}

}  // namespace

bool undo_plane(const KeptGrid& grid, std::span<const std::uint16_t> differences, std::int32_t hole,
                std::span<std::int32_t> values) {
  const std::size_t width = grid.width;
  std::vector<std::uint16_t> set(grid.kept.size() + kBlock);
  const std::uint16_t* next = differences.data();
  std::uint16_t last = 0;
  for (std::size_t j = 0; j < grid.height; ++j) {
    const std::uint8_t* const kept = grid.kept.data() + j * width;
    const KeptRows rows{kept, j > 0 ? kept - width : nullptr, width, grid.kept.size() - j * width};
    std::uint16_t* const row = set.data() + j * width;
    const std::uint16_t* const north = j > 0 ? row - width : nullptr;
    for (std::size_t i = end_of_holes(rows, 0); i < width; i = end_of_holes(rows, i)) {
      if (i > 0 && j > 0 && (kept[i - 1] & rows.north[i] & rows.north[i - 1]) != 0) {
        const std::size_t end = end_of_stretch(rows, i);
        set_stretch(next, end - i, north + i, row + i);
        next += end - i;
        i = end;
      } else {
        row[i] = static_cast<std::uint16_t>(
            predict_plane(neighbours_in(rows, row, north, i), last) + *next++);
        ++i;
      }
      last = row[i - 1];
    }
  }
  assert(next <= differences.data() + differences.size() - kDifferencePadding);
  return store(grid.kept, set.data(), hole, values.data());
}

}  // namespace relief

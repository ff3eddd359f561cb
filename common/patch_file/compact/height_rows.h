// Predicts a row of heights for codec 2 of the patch file, many nodes at a time, except for the
// part that depends on the sample visited just before.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/patch_file/compact/height_predictor.h"
#include "common/patch_file/compact/level_grid.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace relief {

/// Calls `use(k)` for each k below `Count`, each inlined. GCC does not inline the larger ones by
/// default and passes vectors through memory, which takes a fifth of the decoding time.
template <std::size_t Count, class Use>
[[gnu::always_inline]] inline void unrolled(const Use& use) {
  [&]<std::size_t... K>(std::index_sequence<K...>) __attribute__((always_inline)) {
    (use(std::integral_constant<std::size_t, K>()), ...);
  }
  (std::make_index_sequence<Count>());
}

/// The nodes of a row of one pass over a level; node n stands in column first + n * step.
template <const HeightPass& Pass>
class HeightRow {
 public:
  /// Bits of neighbours and near residuals: bit k is set if neighbour k is a sample, bit
  /// kMaxNeighbours + k if the node of near residual k is.
  static constexpr std::size_t kBits = kMaxNeighbours + kNearResiduals;
  static constexpr std::uint32_t kAll = (1U << kBits) - 1U;
  /// The neighbour visited just before a node.
  static constexpr std::size_t kBefore = [] {
    std::size_t k = 0;
    while (Pass.neighbours[k].i != -Pass.step || Pass.neighbours[k].j != 0) ++k;
    return k;
  }();

  /// `of_all` is the table's row for nodes all of whose neighbours are samples.
  HeightRow(const LevelGrid& grid, const PredictorRow& of_all)
      : stride_(static_cast<std::ptrdiff_t>(grid.stride)),
        of_all_(of_all),
        known_(LevelGrid::padded(grid.width) / Pass.step),
        sums_(known_.size()),
        near_(known_.size()) {}

  /// Moves to row j of the grid. Rows above are already visited, and this row by other passes.
  void go_to(const LevelGrid& grid, std::uint32_t j) {
    const std::size_t first = grid.node(Pass.first, j);
    samples_ = &grid.samples[first];
    heights_ = &grid.heights[first];
    magnitudes_ = &grid.magnitudes[first];
    for (std::size_t n = 0; n < known_.size(); n += LevelGrid::kBlock / Pass.step) look_at_block(n);
  }

  /// The samples around node n.
  [[nodiscard]] std::uint32_t known(std::size_t n) const { return known_[n]; }
  /// The sum of weight * height over all neighbours but kBefore, for nodes of kAll.
  [[nodiscard]] std::int32_t sum(std::size_t n) const { return sums_[n]; }
  /// The sum of weight * magnitude over the near residuals of other rows.
  [[nodiscard]] std::uint32_t near(std::size_t n) const { return near_[n]; }

  /// `sum` with other weights; those of holes are 0.
  [[nodiscard]] std::int32_t sum(std::size_t n, const PredictorRow& row) const {
    const std::int16_t* const node = heights_ + n * Pass.step;
    std::int32_t sum = 0;
    unrolled<kMaxNeighbours>([&](auto k) {
      if constexpr (k != kBefore) sum += row.weights[k] * node[offset(Pass.neighbours[k])];
    });
    return sum;
  }

 private:
  /// The visitor handles these: they belong to the row itself.
  static constexpr bool is_elsewhere(NearResidual near) {
    return near.weight > 0 && near.at.j != 0;
  }

  [[nodiscard]] std::ptrdiff_t offset(NodeOffset at) const { return at.j * stride_ + at.i; }

#ifdef __SSE2__
  template <class Value>
  static __m128i load(const Value* from) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
  }
  template <class Value>
  static void store(Value* to, __m128i values) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), values);
  }

  /// Sets bit k from the samples of sixteen columns.
  template <std::size_t Bit>
  [[nodiscard]] __m128i samples(std::size_t n) const {
    constexpr NodeOffset kAt = Bit < kMaxNeighbours
                                   ? Pass.neighbours[Bit % kMaxNeighbours]
                                   : Pass.residuals[(Bit - kMaxNeighbours) % kNearResiduals].at;
    return load(samples_ + n * Pass.step + offset(kAt));
  }

  static __m128i pair(int a, int b) {
    return _mm_set1_epi32(static_cast<int>(static_cast<std::uint32_t>(b) << 16U |
                                           (static_cast<std::uint32_t>(a) & 0xFFFFU)));
  }

  /// Sixteen columns: that many nodes, or half as many in every second one.
  void look_at_block(std::size_t n) {
    // A third of a patch's rectangle has no samples; its nodes need no values.
    const __m128i none = _mm_cmpeq_epi8(load(samples_ + n * Pass.step), _mm_setzero_si128());
    if (_mm_movemask_epi8(none) == 0xFFFF) return;
    if constexpr (Pass.step == 2) {
      find_known_of_eight(n);
      add_near_of_eight(n);
      add_heights_of_eight(n);
    } else {
      find_known_of_sixteen(n);
      add_near_of_sixteen(n);
      add_heights_of_eight(n);
      add_heights_of_eight(n + 8);
    }
  }

  // Bytes of every second column are read as 16-bit numbers with cleared high bytes.

  void find_known_of_eight(std::size_t n) {
    const __m128i low_bytes = _mm_set1_epi16(0xFF);
    __m128i known = _mm_setzero_si128();
    unrolled<kBits>([&](auto k) {
      const __m128i bit = _mm_and_si128(samples<kBits - 1 - k>(n), low_bytes);
      known = _mm_or_si128(_mm_add_epi16(known, known), bit);
    });
    store(&known_[n], known);
  }

  void find_known_of_sixteen(std::size_t n) {
    __m128i first = _mm_setzero_si128();
    __m128i last = _mm_setzero_si128();
    unrolled<8>(
        [&](auto k) { first = _mm_or_si128(_mm_add_epi8(first, first), samples<7 - k>(n)); });
    unrolled<kBits - 8>(
        [&](auto k) { last = _mm_or_si128(_mm_add_epi8(last, last), samples<kBits - 1 - k>(n)); });
    store(&known_[n], _mm_unpacklo_epi8(first, last));
    store(&known_[n + 8], _mm_unpackhi_epi8(first, last));
  }

  void add_near_of_eight(std::size_t n) {
    const __m128i low_bytes = _mm_set1_epi16(0xFF);
    __m128i near = _mm_setzero_si128();
    unrolled<kNearResiduals>([&](auto k) {
      constexpr NearResidual kNear = Pass.residuals[k];
      if constexpr (is_elsewhere(kNear)) {
        const __m128i m =
            _mm_and_si128(load(magnitudes_ + n * Pass.step + offset(kNear.at)), low_bytes);
        near = _mm_add_epi16(near, _mm_mullo_epi16(m, _mm_set1_epi16(kNear.weight)));
      }
    });
    store(&near_[n], near);
  }

  void add_near_of_sixteen(std::size_t n) {
    const __m128i zero = _mm_setzero_si128();
    __m128i low = zero;
    __m128i high = zero;
    unrolled<kNearResiduals>([&](auto k) {
      constexpr NearResidual kNear = Pass.residuals[k];
      if constexpr (is_elsewhere(kNear)) {
        const __m128i m = load(magnitudes_ + n + offset(kNear.at));
        const __m128i weight = _mm_set1_epi16(kNear.weight);
        low = _mm_add_epi16(low, _mm_mullo_epi16(_mm_unpacklo_epi8(m, zero), weight));
        high = _mm_add_epi16(high, _mm_mullo_epi16(_mm_unpackhi_epi8(m, zero), weight));
      }
    });
    store(&near_[n], low);
    store(&near_[n + 8], high);
  }

  /// Products of heights and weights are added in pairs: for every second column, the height
  /// between two columns counts 0; otherwise the pair is two neighbours of a node.
  void add_heights_of_eight(std::size_t n) {
    const auto& weights = of_all_.weights;
    const std::int16_t* const first = heights_ + n * Pass.step;
    __m128i low = _mm_setzero_si128();
    __m128i high = low;
    if constexpr (Pass.step == 2) {
      unrolled<kMaxNeighbours>([&](auto k) {
        if constexpr (k != kBefore) {
          const std::int16_t* const from = first + offset(Pass.neighbours[k]);
          const __m128i weight = pair(weights[k], 0);
          low = _mm_add_epi32(low, _mm_madd_epi16(load(from), weight));
          high = _mm_add_epi32(high, _mm_madd_epi16(load(from + 8), weight));
        }
      });
    } else {
      static_assert(Pass.step == 2 || kBefore == 8, "the first eight are taken by twos");
      unrolled<4>([&](auto k) {
        const __m128i a = load(first + offset(Pass.neighbours[2 * k]));
        const __m128i b = load(first + offset(Pass.neighbours[2 * k + 1]));
        const __m128i weight = pair(weights[2 * k], weights[2 * k + 1]);
        low = _mm_add_epi32(low, _mm_madd_epi16(_mm_unpacklo_epi16(a, b), weight));
        high = _mm_add_epi32(high, _mm_madd_epi16(_mm_unpackhi_epi16(a, b), weight));
      });
    }
    store(&sums_[n], low);
    store(&sums_[n + 4], high);
  }
#else
  void look_at_block(std::size_t n) {
    for (std::size_t m = n; m < n + LevelGrid::kBlock / Pass.step; ++m) {
      const std::size_t i = m * Pass.step;
      std::uint32_t known = 0;
      unrolled<kMaxNeighbours>(
          [&](auto k) { known |= std::uint32_t{(samples_ + i)[offset(Pass.neighbours[k])]} << k; });
      std::uint32_t near = 0;
      unrolled<kNearResiduals>([&](auto k) {
        constexpr NearResidual kNear = Pass.residuals[k];
        known |= std::uint32_t{(samples_ + i)[offset(kNear.at)]} << (kMaxNeighbours + k);
        if constexpr (is_elsewhere(kNear))
          near += kNear.weight * std::uint32_t{(magnitudes_ + i)[offset(kNear.at)]};
      });
      known_[m] = static_cast<std::uint16_t>(known);
      near_[m] = static_cast<std::uint16_t>(near);
      sums_[m] = sum(m, of_all_);
    }
  }
#endif

  std::ptrdiff_t stride_;
  const PredictorRow& of_all_;
  const std::uint8_t* samples_ = nullptr;
  const std::int16_t* heights_ = nullptr;
  const std::uint8_t* magnitudes_ = nullptr;
  std::vector<std::uint16_t> known_;
  std::vector<std::int32_t> sums_;
  std::vector<std::uint16_t> near_;
};

}  // namespace relief

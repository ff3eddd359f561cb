// Finds points at equal positions.
#pragma once

#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace relief {

/// Positions already seen: open addressing, at most half full.
class SeenPositions {
 public:
  explicit SeenPositions(std::size_t count)
      : slots_(std::bit_ceil(2 * count + 2), kEmpty), mask_(slots_.size() - 1) {}

  /// Returns the index of an earlier point at this position that `is_same` accepts; otherwise
  /// stores and returns `index`. Of more than 32 points that differ the last stands for all others,
  /// since a hostile file may have all its points in one place.
  template <class IsSame>
  std::uint32_t find_or_add(const std::vector<glm::dvec3>& positions, std::uint32_t index,
                            const IsSame& is_same) {
    constexpr int kMostAtOnePlace = 32;
    int there = 0;
    for (std::uint64_t slot = hash(positions[index]) & mask_;; slot = (slot + 1) & mask_) {
      const std::uint32_t earlier = slots_[slot];
      if (earlier == kEmpty) return slots_[slot] = index;
      if (positions[earlier] != positions[index]) continue;
      if (is_same(earlier) || ++there == kMostAtOnePlace) return earlier;
    }
  }

  /// Whatever the point.
  std::uint32_t find_or_add(const std::vector<glm::dvec3>& positions, std::uint32_t index) {
    return find_or_add(positions, index, [](std::uint32_t) { return true; });
  }

 private:
  /// Mixes the bits of three doubles (the finaliser of SplitMix64 after each).
  static std::uint64_t hash(glm::dvec3 p) {
    std::uint64_t h = 0;
    for (int i = 0; i < 3; ++i) {
      // Adding zero gives -0 and +0, which are equal, equal bits.
      h += std::bit_cast<std::uint64_t>(p[i] + 0.0) + 0x9E3779B97F4A7C15U;
      h = (h ^ (h >> 30U)) * 0xBF58476D1CE4E5B9U;
      h = (h ^ (h >> 27U)) * 0x94D049BB133111EBU;
      h ^= h >> 31U;
    }
    return h;
  }

  static constexpr std::uint32_t kEmpty = UINT32_MAX;

  std::vector<std::uint32_t> slots_;
  std::uint64_t mask_;
};

}  // namespace relief

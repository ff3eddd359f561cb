#include <algorithm>
#include <bit>
#include <cassert>
#include <glm/vector_relational.hpp>
#include <utility>

#include "common/is_finite.h"
#include "preprocess/points/keep_points.h"
#include "preprocess/readers/read_points.h"
#include "preprocess/readers/source.h"

namespace relief {
namespace {

/// Mixes the bits of three doubles (the finaliser of SplitMix64 after each).
std::uint64_t hash(glm::dvec3 p) {
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

/// Positions already seen: open addressing, at most half full.
class SeenPositions {
 public:
  explicit SeenPositions(std::size_t count)
      : slots_(std::bit_ceil(2 * count + 2), kNoPoint), mask_(slots_.size() - 1) {}

  /// Returns the index of an earlier point at this position; otherwise stores and returns `index`.
  std::uint32_t find_or_add(const std::vector<glm::dvec3>& positions, glm::dvec3 position,
                            std::uint32_t index) {
    for (std::uint64_t slot = hash(position) & mask_;; slot = (slot + 1) & mask_) {
      if (slots_[slot] == kNoPoint) return slots_[slot] = index;
      if (positions[slots_[slot]] == position) return slots_[slot];
    }
  }

 private:
  std::vector<std::uint32_t> slots_;
  std::uint64_t mask_;
};

/// Formats with one texture coordinate a point repeat the points of a seam for each side. Merged
/// points keep one side's, so the triangles get their corners' own.
void keep_seams(Points& points) {
  const auto count = points.size();
  points.corner_texcoords.reserve(points.triangles.size());
  for (const Triangle& t : points.triangles) {
    CornerTexcoords corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      if (t[c] < count) corners[c] = points.texcoords[t[c]];
    }
    points.corner_texcoords.push_back(corners);
  }
}

}  // namespace

ReadResult clean_points(Points points, std::vector<std::uint32_t>* number) {
  assert(points.size() < kNoPoint &&
         "readers and callers refuse more points than 32 bits can index");
  ReadResult result;
  result.points_in_file = points.size();
  const auto count = static_cast<std::uint32_t>(points.size());
  std::vector<std::uint32_t> new_index(count, kNoPoint);
  std::vector<std::uint32_t> kept;
  kept.reserve(count);
  SeenPositions seen(count);
  bool seam = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!is_finite(points.positions[i])) {
      ++result.dropped_nonfinite;
      continue;
    }
    const std::uint32_t first = seen.find_or_add(points.positions, points.positions[i], i);
    if (first == i) {
      new_index[i] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(i);
      continue;
    }
    ++result.merged_duplicates;
    new_index[i] = new_index[first];
    seam = seam || (!points.texcoords.empty() && points.texcoords[i] != points.texcoords[first]);
    add_normal(points, first, i);
  }
  if (seam && points.corner_texcoords.empty()) keep_seams(points);
  keep_points(points, kept, new_index);
  result.points = std::move(points);
  if (number != nullptr) *number = std::move(new_index);
  return result;
}

}  // namespace relief

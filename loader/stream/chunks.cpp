#include "loader/stream/chunks.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace relief {
namespace {

constexpr std::uint32_t kOrderBits = 10;

/// Places three bits of zeros between the bits of a number of kOrderBits bits.
std::uint64_t spread(std::uint64_t number) {
  std::uint64_t bits = 0;
  for (std::uint32_t b = 0; b < kOrderBits; ++b) bits |= (number >> b & 1U) << (3 * b);
  return bits;
}

/// The place along a curve on which neighbours are near each other (Morton).
std::uint64_t place_of(const glm::dvec3& p, const Bounds& box) {
  const glm::dvec3 size = glm::max(box.max - box.min, glm::dvec3(1e-300));
  const glm::dvec3 share = glm::clamp((p - box.min) / size, 0.0, 1.0);
  const auto step = [](double x) {
    return static_cast<std::uint64_t>(x * ((1U << kOrderBits) - 1));
  };
  return spread(step(share.x)) | spread(step(share.y)) << 1U | spread(step(share.z)) << 2U;
}

}  // namespace

TileIndex index_tile(std::span<const PatchSummary> patches, bool are_joined) {
  struct Placed {
    std::uint64_t place = 0;
    std::uint32_t patch = 0;
  };
  std::vector<Bounds> boxes;
  boxes.reserve(patches.size());
  Bounds all;
  std::vector<Placed> order;
  for (std::uint32_t p = 0; p < patches.size(); ++p) {
    boxes.push_back(box_of(patches[p]));
    if (patches[p].samples == 0) continue;
    extend(all, boxes.back().min);
    extend(all, boxes.back().max);
    order.push_back({0, p});
  }
  if (!are_joined) {
    for (Placed& placed : order) {
      const Bounds& box = boxes[placed.patch];
      placed.place = place_of(0.5 * (box.min + box.max), all);
    }
    std::stable_sort(order.begin(), order.end(),
                     [](const Placed& a, const Placed& b) { return a.place < b.place; });
  }
  TileIndex index;
  for (const Placed& placed : order) {
    const PatchSummary& patch = patches[placed.patch];
    const std::uint64_t nodes = std::uint64_t{patch.width} * patch.height;
    const bool is_full = !index.chunks.empty() && index.chunks.back().nodes + nodes > kChunkNodes;
    if (index.chunks.empty() || (is_full && !are_joined)) index.chunks.emplace_back();
    ChunkInfo& chunk = index.chunks.back();
    chunk.patches.push_back(placed.patch);
    extend(chunk.box, boxes[placed.patch].min);
    extend(chunk.box, boxes[placed.patch].max);
    chunk.spacing = std::max(chunk.spacing, patch.spacing);
    chunk.nodes += nodes;
    chunk.samples += patch.samples;
    chunk.is_joined = are_joined;
  }
  return index;
}

}  // namespace relief

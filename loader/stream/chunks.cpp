#include "loader/stream/chunks.h"

#include <algorithm>
#include <utility>

#include "common/neighbours/morton.h"

namespace relief {
TileIndex index_tile(std::span<const PatchSummary> patches, bool are_joined) {
  std::vector<Bounds> boxes;
  boxes.reserve(patches.size());
  Bounds all;
  std::vector<std::uint32_t> order;
  for (std::uint32_t p = 0; p < patches.size(); ++p) {
    boxes.push_back(box_of(patches[p]));
    if (patches[p].samples == 0) continue;
    extend(all, boxes.back().min);
    extend(all, boxes.back().max);
    order.push_back(p);
  }
  if (!are_joined) {
    std::vector<std::uint64_t> codes;
    codes.reserve(order.size());
    for (const std::uint32_t p : order)
      codes.push_back(morton_code(0.5 * (boxes[p].min + boxes[p].max), all));
    std::vector<std::uint32_t> sorted;
    sorted.reserve(order.size());
    for (const std::uint32_t k : order_of(codes)) sorted.push_back(order[k]);
    order = std::move(sorted);
  }
  TileIndex index;
  for (const std::uint32_t p : order) {
    const PatchSummary& patch = patches[p];
    const std::uint64_t nodes = std::uint64_t{patch.width} * patch.height;
    const bool is_full = !index.chunks.empty() && index.chunks.back().nodes + nodes > kChunkNodes;
    if (index.chunks.empty() || (is_full && !are_joined)) index.chunks.emplace_back();
    ChunkInfo& chunk = index.chunks.back();
    chunk.patches.push_back(p);
    extend(chunk.box, boxes[p].min);
    extend(chunk.box, boxes[p].max);
    chunk.spacing = std::max(chunk.spacing, patch.spacing);
    chunk.nodes += nodes;
    chunk.samples += patch.samples;
    chunk.is_joined = are_joined;
  }
  return index;
}

}  // namespace relief

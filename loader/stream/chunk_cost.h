// What chunks take on the GPU, and how a budget is divided among its kinds of memory.
#pragma once

#include <cstdint>

#include "loader/stream/tile_source.h"
#include "renderer/store/pool/patch_chunk.h"

namespace relief {

/// Bytes of the GPU.
struct ChunkCost {
  MapBytes maps = {};
  double rest = 0.0;  ///< of cells, records and seams

  [[nodiscard]] double all() const;
  /// Whether there is as much room of each kind of memory.
  [[nodiscard]] bool fits(const ChunkCost& room) const;

  ChunkCost& operator+=(const ChunkCost& more);
};

[[nodiscard]] ChunkCost operator*(double times, const ChunkCost& cost);

/// What the finest level of cells takes of a node, beside the coarser ones.
inline constexpr double kFinestBytesANode = 5.0;

/// Returns what a chunk takes.
[[nodiscard]] ChunkCost cost_of(const PatchChunk& chunk);

/// Returns about what a node of patches of a kind takes.
[[nodiscard]] ChunkCost usual_cost_a_node(const PatchKind& kind, const StoreNeeds& needs);

/// Divides `bytes` among kinds of memory, a half each as the finest patches and as overviews need
/// it: those have fewer colours, and views show from nearly none of them to half. Less if all
/// `nodes` of a file need less. `fine`, `coarse`: usual_cost_a_node().
[[nodiscard]] ChunkCost divide_budget(std::uint64_t bytes, const ChunkCost& fine,
                                      const ChunkCost& coarse, double nodes);

}  // namespace relief

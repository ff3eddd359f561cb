#include "renderer/store/pool/patch_chunk.h"

#include <utility>

namespace relief {
namespace {

template <class T>
std::uint64_t bytes_of(const std::vector<T>& list) {
  return list.size() * sizeof(T);
}

}  // namespace

std::uint64_t PatchChunk::bytes() const {
  std::uint64_t sum = bytes_of(lists.patches) + bytes_of(lists.levels) + bytes_of(lists.parts) +
                      bytes_of(lists.positions) + bytes_of(lists.seams) + bytes_of(table) +
                      bytes_of(seam_vertices) + bytes_of(seam_corners) + bytes_of(boxes);
  for (const CellPageData& page : cells) sum += page.bytes();
  for (const std::vector<SampleRecord>& page : records) sum += bytes_of(page);
  for (const auto* band : {&maps.heights, &maps.normals, &maps.colours, &maps.masks}) {
    if (*band) sum += bytes_of((*band)->texels);
  }
  return sum;
}

Result<PatchChunk> prepare_chunk(const PatchModel& model, std::span<const std::uint32_t> ids,
                                 const StoreNeeds& needs, const StoreLimits& limits,
                                 std::uint32_t finest) {
  if (!model.joined.empty()) finest = 0;
  const UploadViews views{{}, true, finest};
  ModelCollector collector(limits, model, needs, views);
  const auto count = static_cast<std::uint32_t>(model.patches.size());
  RELIEF_TRY(collector.add({0, count, {}, 0, model.is_closed}));
  PatchChunk chunk;
  chunk.finest = finest;
  chunk.maps = collector.grids().make_bands();
  RELIEF_TRY(collector.add_seam_blocks());
  chunk.table = collector.table();
  for (shared::PatchInfo& row : chunk.table)
    row.nodes.z = static_cast<int>(ids[static_cast<std::size_t>(row.nodes.z)]);
  chunk.cells = collector.grids().take_cells();
  chunk.records = collector.grids().take_records();
  chunk.seam_vertices = std::move(collector.seams().vertices());
  chunk.seam_corners = std::move(collector.seams().corners());
  chunk.lists = std::move(collector.collected());
  return chunk;
}

}  // namespace relief

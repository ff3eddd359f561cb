#include "loader/stream/chunk_cost.h"

#include <algorithm>

namespace relief {
namespace {

/// Room for a map over its texels: 1.18 to 1.22 of 60 million points.
constexpr double kPacking = 1.2;
/// All levels of a patch over the finest.
constexpr double kLevels = 4.0 / 3.0;
/// Of cells from kUsualFinest on, with what the CPU keeps of them: 4.3 to 5.7 of whole views. Where
/// all levels are needed, few nodes are in view.
constexpr double kCellBytesANode = 6.0;
/// A file that needs less than the budget gets no more, and this for gaps.
constexpr double kSlack = 1.4;

double sum_of(const MapBytes& maps) {
  return maps.heights + maps.normals + maps.colours + maps.masks;
}

}  // namespace

double ChunkCost::all() const {
  return sum_of(maps) + rest;
}

bool ChunkCost::fits(const ChunkCost& room) const {
  return maps.heights <= room.maps.heights && maps.normals <= room.maps.normals &&
         maps.colours <= room.maps.colours && maps.masks <= room.maps.masks && rest <= room.rest;
}

ChunkCost& ChunkCost::operator+=(const ChunkCost& more) {
  maps.heights += more.maps.heights;
  maps.normals += more.maps.normals;
  maps.colours += more.maps.colours;
  maps.masks += more.maps.masks;
  rest += more.rest;
  return *this;
}

ChunkCost operator*(double times, const ChunkCost& cost) {
  return {{times * cost.maps.heights, times * cost.maps.normals, times * cost.maps.colours,
           times * cost.maps.masks},
          times * cost.rest};
}

ChunkCost cost_of(const PatchChunk& chunk) {
  const MapBytes maps = bytes_of(chunk.maps);
  return {maps, static_cast<double>(chunk.bytes()) - sum_of(maps)};
}

ChunkCost usual_cost_a_node(const PatchKind& kind, const StoreNeeds& needs) {
  const auto texels = [](std::uint32_t a_cell) { return double(a_cell) * a_cell * kPacking; };
  ChunkCost cost;
  cost.maps.masks = needs.masks ? texels(1) : 0.0;
  cost.maps.normals = needs.normals ? texels(kind.normal_texels) * sizeof(glm::i16vec2) : 0.0;
  cost.maps.colours = needs.colours ? texels(kind.colour_texels) * sizeof(glm::u8vec4) : 0.0;
  cost.maps.heights = needs.heights ? kLevels * texels(1) * sizeof(std::uint16_t) : 0.0;
  cost.rest = (needs.cells ? kCellBytesANode : 0.0) +
              (needs.splats ? kLevels * sizeof(SampleRecord) / kind.nodes_a_sample : 0.0);
  return cost;
}

ChunkCost divide_budget(std::uint64_t bytes, const ChunkCost& fine, const ChunkCost& coarse,
                        double nodes) {
  const double half = 0.5 * static_cast<double>(bytes);
  ChunkCost room = half / fine.all() * fine;
  room += half / coarse.all() * coarse;
  const ChunkCost most = kSlack * nodes * fine;
  return {
      {std::min(room.maps.heights, most.maps.heights),
       std::min(room.maps.normals, most.maps.normals),
       std::min(room.maps.colours, most.maps.colours), std::min(room.maps.masks, most.maps.masks)},
      std::min(room.rest, most.rest)};
}

}  // namespace relief

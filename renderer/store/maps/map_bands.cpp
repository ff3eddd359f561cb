#include "renderer/store/maps/map_bands.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include "renderer/store/maps/map_upload.h"
#include "renderer/store/maps/strip_packer.h"

namespace relief {
namespace {

/// A strip of whole columns of the pool, of all that are not much wider the smallest.
struct Strip {
  std::uint32_t width = 0;
  PackedStrip packed;
};

Strip smallest_strip(std::span<const glm::uvec2> sizes) {
  constexpr std::uint32_t kMostColumns = 2;
  std::uint32_t columns = 1;
  for (const glm::uvec2 size : sizes)
    columns = std::max(columns, (size.x + kBandWidth - 1) / kBandWidth);
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  Strip best;
  for (std::uint32_t c = columns; c <= std::max(columns, kMostColumns); ++c) {
    Strip strip{c * kBandWidth, pack_strip(sizes, c * kBandWidth)};
    const std::uint64_t area = std::uint64_t{strip.width} * strip.packed.height;
    if (area >= least) continue;
    least = area;
    best = std::move(strip);
  }
  return best;
}

/// Packs maps and copies them there. `pad` gives the map of a patch with a ring of `ring` texels
/// around it.
template <class Pad>
PackedMaps pack(const PatchList& patches, std::uint32_t ring, const Pad& pad) {
  using Map = decltype(pad(*patches.front()));
  std::vector<Map> maps;
  maps.reserve(patches.size());
  for (const Patch* patch : patches) maps.push_back(pad(*patch));
  std::vector<glm::uvec2> sizes;
  sizes.reserve(maps.size());
  for (const Map& map : maps) sizes.emplace_back(map.width, map.height);
  const auto [width, strip] = smallest_strip(sizes);

  PackedMaps packed;
  constexpr std::size_t kBytes = sizeof(maps.front().texels.front());
  packed.band = {width, strip.height,
                 std::vector<std::byte>(std::size_t{width} * strip.height * kBytes)};
  for (std::size_t m = 0; m < maps.size(); ++m) {
    const Map& map = maps[m];
    const glm::uvec2 spot = strip.corners[m];
    for (std::uint32_t y = 0; y < map.height; ++y) {
      std::memcpy(packed.band.texels.data() + (std::size_t{spot.y + y} * width + spot.x) * kBytes,
                  map.texels.data() + std::size_t{y} * map.width, map.width * kBytes);
    }
    packed.spots.push_back({spot.x + ring, spot.y + ring, 0});
  }
  return packed;
}

}  // namespace

MapBytes bytes_of(const MapBands& bands) {
  const auto of = [](const std::optional<MapBand>& band) {
    return band ? static_cast<double>(band->texels.size()) : 0.0;
  };
  return {of(bands.heights), of(bands.normals), of(bands.colours), of(bands.masks)};
}

PackedMaps pack_heights(const PatchList& patches) {
  return pack(patches, 0, [](const Patch& patch) { return padded_heights(patch); });
}

PackedMaps pack_normals(const PatchList& patches) {
  return pack(patches, 1, [](const Patch& patch) { return padded_normals(patch, MipRoom()); });
}

PackedMaps pack_colours(const PatchList& patches) {
  return pack(patches, 1, [](const Patch& patch) { return padded_colours(patch, MipRoom()); });
}

PackedMaps pack_masks(const PatchList& patches, const MeetsOthers& meets) {
  return pack(patches, 1, [&](const Patch& patch) { return padded_mask(patch, meets(patch)); });
}

}  // namespace relief

#include "renderer/store/map_bands.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "renderer/store/map_upload.h"

namespace relief {
namespace {

/// Packs maps in shelves, highest first, and copies them there. `pad` gives the map of a patch with
/// a ring of `ring` texels around it.
template <class Pad>
PackedMaps pack(const PatchList& patches, std::uint32_t width, std::uint32_t ring, const Pad& pad) {
  using Map = decltype(pad(*patches.front()));
  std::vector<Map> maps;
  maps.reserve(patches.size());
  for (const Patch* patch : patches) maps.push_back(pad(*patch));
  for (const Map& map : maps) width = std::max(width, map.width);
  std::vector<std::size_t> order(maps.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&maps](std::size_t a, std::size_t b) {
    return maps[a].height > maps[b].height;
  });

  PackedMaps packed;
  packed.spots.resize(maps.size());
  AtlasSpot next;
  std::uint32_t top = 0;  // of the shelf
  for (const std::size_t m : order) {
    if (next.x + maps[m].width > width) next = {0, top, 0};
    packed.spots[m] = next;
    next.x += maps[m].width;
    top = std::max(top, next.y + maps[m].height);
  }
  constexpr std::size_t kBytes = sizeof(maps.front().texels.front());
  packed.band = {width, top, std::vector<std::byte>(std::size_t{width} * top * kBytes)};
  for (std::size_t m = 0; m < maps.size(); ++m) {
    const Map& map = maps[m];
    AtlasSpot& spot = packed.spots[m];
    for (std::uint32_t y = 0; y < map.height; ++y) {
      std::memcpy(packed.band.texels.data() + (std::size_t{spot.y + y} * width + spot.x) * kBytes,
                  map.texels.data() + std::size_t{y} * map.width, map.width * kBytes);
    }
    spot.x += ring;
    spot.y += ring;
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
  return pack(patches, kBandWidth, 0, [](const Patch& patch) { return padded_heights(patch); });
}

PackedMaps pack_normals(const PatchList& patches) {
  return pack(patches, kBandWidth, 1,
              [](const Patch& patch) { return padded_normals(patch, MipRoom()); });
}

PackedMaps pack_colours(const PatchList& patches) {
  return pack(patches, kColourBandWidth, 1,
              [](const Patch& patch) { return padded_colours(patch, MipRoom()); });
}

PackedMaps pack_masks(const PatchList& patches, const MeetsOthers& meets) {
  return pack(patches, kBandWidth, 1,
              [&](const Patch& patch) { return padded_mask(patch, meets(patch)); });
}

}  // namespace relief

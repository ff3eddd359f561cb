// Maps of some patches packed into one image, for a model whose patches come and go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "common/patch.h"
#include "renderer/store/maps/atlas.h"

namespace relief {

/// Bands are so many texels wide, or some times as many: about the side of a square that the maps
/// of some 100,000 samples fill.
inline constexpr std::uint32_t kBandWidth = 512;

/// An image that becomes some rows of a layer of an array texture.
struct MapBand {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::byte> texels;  ///< row by row, in the array's format
};

/// Those that are needed (StoreNeeds).
struct MapBands {
  std::optional<MapBand> heights;
  std::optional<MapBand> normals;
  std::optional<MapBand> colours;
  std::optional<MapBand> masks;
};

/// Bytes of the texels of each.
struct MapBytes {
  double heights = 0.0;
  double normals = 0.0;
  double colours = 0.0;
  double masks = 0.0;
};

[[nodiscard]] MapBytes bytes_of(const MapBands& bands);

/// A band, and where texel (0, 0) of each patch's map lies in it; layers are 0.
struct PackedMaps {
  MapBand band;
  std::vector<AtlasSpot> spots;
};

/// Pack what upload_heights() and the others (map_upload.h) upload, without mip levels.
[[nodiscard]] PackedMaps pack_heights(const std::vector<const Patch*>& patches);
[[nodiscard]] PackedMaps pack_normals(const std::vector<const Patch*>& patches);
[[nodiscard]] PackedMaps pack_colours(const std::vector<const Patch*>& patches);
[[nodiscard]] PackedMaps pack_masks(const std::vector<const Patch*>& patches,
                                    const std::function<bool(const Patch&)>& meets);

}  // namespace relief

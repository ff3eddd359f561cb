// The maps of all patches, as array textures.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/store/maps/atlas.h"

namespace relief {

/// An array texture and where each patch's map begins in it (its texel (0, 0)).
struct MapArray {
  Texture texture;
  std::vector<AtlasSpot> spots;
};

/// The patches whose maps are uploaded.
using PatchList = std::vector<const Patch*>;
/// Whether a patch of a list meets others (PatchModel::joined).
using MeetsOthers = std::function<bool(const Patch&)>;

/// The room that a kind of map takes for its mip levels.
struct MipRoom {
  std::uint32_t levels = 0;  ///< coarser ones
  std::uint32_t ring = 1;    ///< texels around each map

  [[nodiscard]] glm::uvec2 padded(glm::uvec2 size) const {
    return whole_blocks(size + 2 * ring, 1U << levels);
  }
};

/// A map with what surrounds it, as it is uploaded.
template <class Texel>
struct PaddedMap {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<Texel> texels;
};

/// The map of one patch as the functions below upload it.
[[nodiscard]] PaddedMap<std::uint16_t> padded_heights(const Patch& patch);
[[nodiscard]] PaddedMap<std::uint8_t> padded_mask(const Patch& patch, bool meets);
[[nodiscard]] PaddedMap<glm::i16vec2> padded_normals(const Patch& patch, const MipRoom& room);
[[nodiscard]] PaddedMap<glm::u8vec4> padded_colours(const Patch& patch, const MipRoom& room);

/// How a kind of map is kept by OpenGL.
struct MapFormat {
  const char* label;
  GLenum internal;
  GLenum format;
  GLenum type;
  GLint filter;
  GLsizei mip_levels = 0;  ///< coarser ones; maps lie in blocks of that power of two
};

[[nodiscard]] MapFormat height_format();
[[nodiscard]] MapFormat mask_format();
[[nodiscard]] MapFormat normal_format();
/// `nearest`: as upload_colours has it.
[[nodiscard]] MapFormat colour_format(bool nearest);

/// Makes an array texture of that format, without texels. Fails if OpenGL has no memory for it.
Result<Texture> make_map_array(const Gl& gl, const MapFormat& format, glm::uvec2 size,
                               std::uint32_t layers);

/// Heights as 16-bit unsigned integers; holes, and a column and a row beyond the last, are
/// shared::kHoleTexel.
Result<MapArray> upload_heights(const Gl& gl, const PatchList& patches);

/// Normals for bilinear lookups, signed normalised: half their stereographic coordinates seen from
/// the pole below, smooth wherever a patch's normals are. (Octahedral coordinates, as patches keep
/// them, have creases along both axes; interpolated across those a normal is off by up to a fifth
/// of the turn between two texels.) Normals that point steeper down than 37 degrees are bent up to
/// that. A ring of texels around each map repeats its edge. Where a map is fine the array has mip
/// levels as that of fine colours has. A patch without a normal map gets the normals of its
/// heights.
Result<MapArray> upload_normals(const Gl& gl, const PatchList& patches);

/// Whether some patch has several normal texels a cell, as those of meshes with normal maps have.
/// Such models are drawn with mip levels and anisotropic filtering (RELIEF_FEATURE_FINE_NORMALS).
[[nodiscard]] bool has_fine_normals(const PatchModel& model);

/// Whether some patch has more colour texels a cell than coloured points get. Such models are drawn
/// with mip levels and anisotropic filtering (RELIEF_FEATURE_FINE_COLOURS).
[[nodiscard]] bool has_fine_colours(const PatchModel& model);

/// Colours as sRGB, with the same ring. Where a map is fine the array has mip levels, two beyond a
/// texel a cell; each map then begins at a multiple of the coarsest level's texel and has a ring of
/// half of one (2 cells) or more, so that no level mixes maps. A patch without colours gets one
/// texel that nobody reads: the neutral grey is the shader's, for 8-bit sRGB has no value for it.
/// `nearest`: lookups take the nearest texel, for colours that stand for labels.
Result<MapArray> upload_colours(const Gl& gl, const PatchList& patches, bool nearest = false);

/// Masks: 1 at samples, 0 at holes and in a ring around each mask; of patches that overlap others
/// the means of PatchBorder.
Result<MapArray> upload_masks(const Gl& gl, const PatchList& patches, const MeetsOthers& meets);

/// Texels per cell of a patch's map on the GPU (0 for the one texel of a patch without colours).
[[nodiscard]] std::int32_t normal_scale(const Patch& patch);
[[nodiscard]] std::int32_t colour_scale(const Patch& patch);

}  // namespace relief

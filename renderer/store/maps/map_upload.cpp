#include "renderer/store/maps/map_upload.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <utility>

#include "common/image/srgb.h"
#include "common/octahedral.h"
#include "renderer/geometry/cells/patch_border.h"
#include "renderer/geometry/patch_normals.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// More texels a cell than this, the converter's for coloured points, make a fine map.
constexpr std::uint32_t kUsualScale = 2;
/// Two levels beyond a texel a cell: coarser ones of cells, too, are seen at several pixels a cell.
constexpr std::uint32_t kLevelsBeyondCells = 2;

void set_filter(const Gl& gl, GLuint id, const MapFormat& format) {
  gl.TextureParameteri(id, GL_TEXTURE_MAG_FILTER, format.filter);
  gl.TextureParameteri(id, GL_TEXTURE_MIN_FILTER,
                       format.mip_levels > 0 ? GL_LINEAR_MIPMAP_LINEAR : format.filter);
  gl.TextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

/// Makes the array and uploads the padded maps that `pad` gives for each patch; `sizes` are theirs.
template <class Pad>
Result<MapArray> upload(const Gl& gl, const PatchList& patches, const MapFormat& format,
                        const std::vector<glm::uvec2>& sizes, std::uint32_t ring, const Pad& pad) {
  const auto largest = static_cast<std::uint32_t>(get_limit(gl, GL_MAX_TEXTURE_SIZE));
  const auto most = static_cast<std::uint32_t>(get_limit(gl, GL_MAX_ARRAY_TEXTURE_LAYERS));
  const std::uint32_t block = 1U << static_cast<std::uint32_t>(format.mip_levels);
  std::optional<Atlas> atlas = pack_atlas(sizes, largest, most, block);
  if (!atlas) {
    return make_error(
        "the {} are larger than this OpenGL allows ({} texels a side, {} layers); "
        "convert again with a larger spacing{}",
        format.label, largest, most, format.mip_levels > 0 ? " or fewer texels a cell" : "");
  }
  RELIEF_TRY_ASSIGN(Texture texture, make_map_array(gl, format, atlas->size, atlas->layers));
  MapArray array{std::move(texture), std::move(atlas->spots)};
  const GLuint id = array.texture.id();

  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const auto map = pad(*patches[p]);
    AtlasSpot& spot = array.spots[p];
    gl.TextureSubImage3D(id, 0, static_cast<GLint>(spot.x), static_cast<GLint>(spot.y),
                         static_cast<GLint>(spot.layer), static_cast<GLsizei>(map.width),
                         static_cast<GLsizei>(map.height), 1, format.format, format.type,
                         map.texels.data());
    spot.x += ring;
    spot.y += ring;
  }
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  // Means in linear light, as OpenGL makes them of sRGB textures; of normals means of stereographic
  // coordinates, which need no length put right.
  if (format.mip_levels > 0) gl.GenerateTextureMipmap(id);
  return array;
}

/// A map of `size` texels with a ring of `ring` texels or more around it that repeats its edge, so
/// that no lookup sees the map beside it.
template <class Out, class In>
PaddedMap<Out> with_ring(const AttributeMap<In>& map, glm::uvec2 size, std::uint32_t ring) {
  PaddedMap<Out> padded{size.x, size.y, {}};
  padded.texels.reserve(std::size_t{padded.width} * padded.height);
  for (std::uint32_t y = 0; y < padded.height; ++y) {
    const std::uint32_t j = std::clamp(y, ring, map.height + ring - 1) - ring;
    for (std::uint32_t x = 0; x < padded.width; ++x) {
      const std::uint32_t i = std::clamp(x, ring, map.width + ring - 1) - ring;
      const In& texel = map.texels[std::size_t{j} * map.width + i];
      if constexpr (Out::length() == In::length()) {
        padded.texels.push_back(texel);
      } else {
        padded.texels.push_back(Out(texel, 255));
      }
    }
  }
  return padded;
}

/// `finest`: texels a cell; not `fine`: no mip levels.
MipRoom room_for(std::uint32_t finest, bool fine) {
  if (!fine) return {};
  const std::uint32_t levels =
      static_cast<std::uint32_t>(std::bit_width(finest - 1)) + kLevelsBeyondCells;
  // At the coarsest level half a texel, which is what a bilinear lookup sees beyond a position.
  return {levels, 1U << (levels - 1)};
}

/// Half the stereographic coordinates, which reach 1 where a normal points down by 37 degrees.
glm::i16vec2 stereographic_from_octahedral(glm::i16vec2 octahedral) {
  const glm::vec3 n = unit_from_snorm16(octahedral);
  glm::vec2 half = 0.5F * glm::vec2(n) / std::max(1.0F + n.z, 1e-6F);
  half /= std::max(glm::length(half), 1.0F);
  return glm::i16vec2(glm::round(32767.0F * half));
}

const AttributeMap<glm::u8vec3>& colours_of(const Patch& patch) {
  static const AttributeMap<glm::u8vec3> no_colours{1, 1, 1, {glm::u8vec3(0)}};
  return patch.colours.empty() ? no_colours : patch.colours;
}

}  // namespace

std::int32_t normal_scale(const Patch& patch) {
  return patch.normals.empty() ? 1 : static_cast<std::int32_t>(patch.normals.scale);
}

std::int32_t colour_scale(const Patch& patch) {
  return patch.colours.empty() ? 0 : static_cast<std::int32_t>(patch.colours.scale);
}

PaddedMap<std::uint16_t> padded_heights(const Patch& patch) {
  PaddedMap<std::uint16_t> map{patch.width + 1, patch.height + 1, {}};
  map.texels.resize(std::size_t{map.width} * map.height,
                    static_cast<std::uint16_t>(shared::kHoleTexel));
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      const std::int32_t h = patch.at(i, j);
      if (h != kHole) map.texels[std::size_t{j} * map.width + i] = static_cast<std::uint16_t>(h);
    }
  }
  return map;
}

PaddedMap<std::uint8_t> padded_mask(const Patch& patch, bool meets) {
  PaddedMap<std::uint8_t> map{patch.width + 2, patch.height + 2, {}};
  map.texels.reserve(std::size_t{map.width} * map.height);
  const PatchBorder border(patch);
  for (std::uint32_t j = 0; j < map.height; ++j) {
    for (std::uint32_t i = 0; i < map.width; ++i) {
      const glm::i32vec2 node = glm::i32vec2(i, j) - 1;
      const float texel = meets ? (border.is_sample(node) ? 1.0F : 0.0F) : border.mean_at(node);
      map.texels.push_back(static_cast<std::uint8_t>(std::lround(255.0F * texel)));
    }
  }
  return map;
}

PaddedMap<glm::i16vec2> padded_normals(const Patch& patch, const MipRoom& room) {
  AttributeMap<glm::i16vec2> map = normal_map_of(patch);
  for (glm::i16vec2& texel : map.texels) texel = stereographic_from_octahedral(texel);
  return with_ring<glm::i16vec2>(map, room.padded({map.width, map.height}), room.ring);
}

PaddedMap<glm::u8vec4> padded_colours(const Patch& patch, const MipRoom& room) {
  const AttributeMap<glm::u8vec3>& map = colours_of(patch);
  return with_ring<glm::u8vec4>(map, room.padded({map.width, map.height}), room.ring);
}

MapFormat height_format() {
  return {"height maps", GL_R16UI, GL_RED_INTEGER, GL_UNSIGNED_SHORT, GL_NEAREST};
}

MapFormat mask_format() {
  return {"masks", GL_R8, GL_RED, GL_UNSIGNED_BYTE, GL_LINEAR};
}

MapFormat normal_format() {
  return {"normal maps", GL_RG16_SNORM, GL_RG, GL_SHORT, GL_LINEAR};
}

MapFormat colour_format(bool nearest) {
  return {"colour maps", GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE,
          nearest ? GL_NEAREST : GL_LINEAR};
}

Result<Texture> make_map_array(const Gl& gl, const MapFormat& format, glm::uvec2 size,
                               std::uint32_t layers) {
  Texture texture(gl, format.label, GLenum{GL_TEXTURE_2D_ARRAY});
  gl.TextureStorage3D(texture.id(), 1 + format.mip_levels, format.internal,
                      static_cast<GLsizei>(size.x), static_cast<GLsizei>(size.y),
                      static_cast<GLsizei>(layers));
  set_filter(gl, texture.id(), format);
  RELIEF_TRY(check_errors(gl, format.label));
  return texture;
}

Result<MapArray> upload_heights(const Gl& gl, const PatchList& patches) {
  std::vector<glm::uvec2> sizes;
  for (const Patch* patch : patches) sizes.emplace_back(patch->width + 1, patch->height + 1);
  return upload(gl, patches, height_format(), sizes, 0, padded_heights);
}

Result<MapArray> upload_masks(const Gl& gl, const PatchList& patches, const MeetsOthers& meets) {
  std::vector<glm::uvec2> sizes;
  for (const Patch* patch : patches) sizes.emplace_back(patch->width + 2, patch->height + 2);
  return upload(gl, patches, mask_format(), sizes, 1,
                [&](const Patch& patch) { return padded_mask(patch, meets(patch)); });
}

Result<MapArray> upload_normals(const Gl& gl, const PatchList& patches) {
  std::uint32_t finest = 1;
  for (const Patch* patch : patches)
    finest = std::max(finest, static_cast<std::uint32_t>(normal_scale(*patch)));
  const MipRoom room = room_for(finest, finest > 1);
  std::vector<glm::uvec2> sizes;
  for (const Patch* patch : patches) {
    const bool own = !patch->normals.empty();
    sizes.push_back(room.padded(
        {own ? patch->normals.width : patch->width, own ? patch->normals.height : patch->height}));
  }
  MapFormat format = normal_format();
  format.mip_levels = static_cast<GLsizei>(room.levels);
  return upload(gl, patches, format, sizes, room.ring,
                [&](const Patch& patch) { return padded_normals(patch, room); });
}

bool has_fine_normals(const PatchModel& model) {
  return std::any_of(model.patches.begin(), model.patches.end(),
                     [](const Patch& patch) { return normal_scale(patch) > 1; });
}

bool has_fine_colours(const PatchModel& model) {
  return std::any_of(model.patches.begin(), model.patches.end(), [](const Patch& patch) {
    return !patch.colours.empty() && patch.colours.scale > kUsualScale;
  });
}

Result<MapArray> upload_colours(const Gl& gl, const PatchList& patches, bool nearest) {
  std::uint32_t finest = 0;
  for (const Patch* patch : patches) finest = std::max(finest, colours_of(*patch).scale);
  const MipRoom room = room_for(finest, finest > kUsualScale);
  std::vector<glm::uvec2> sizes;
  for (const Patch* patch : patches) {
    const AttributeMap<glm::u8vec3>& map = colours_of(*patch);
    sizes.push_back(room.padded({map.width, map.height}));
  }
  MapFormat format = colour_format(nearest);
  format.mip_levels = static_cast<GLsizei>(room.levels);
  return upload(gl, patches, format, sizes, room.ring,
                [&](const Patch& patch) { return padded_colours(patch, room); });
}

}  // namespace relief

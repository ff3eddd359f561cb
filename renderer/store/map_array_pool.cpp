#include "renderer/store/map_array_pool.h"

#include <algorithm>
#include <utility>

namespace relief {
namespace {

/// Of a layer that is made for a single band, unless that is higher.
constexpr std::uint32_t kFewestRows = 1024;
/// Bands of a few hundred rows leave a gap in each layer: few high layers have few.
constexpr std::uint32_t kMostRows = 8192;

}  // namespace

std::uint64_t MapArrayPool::bytes() const {
  return std::uint64_t{width_} * rows_ * layers_.size() * texel_bytes_;
}

std::optional<AtlasSpot> MapArrayPool::find_room(std::uint32_t rows) {
  for (std::uint32_t layer = 0; layer < layers_.size(); ++layer) {
    if (const auto first = layers_[layer].take(rows)) return AtlasSpot{0, *first, layer};
  }
  return std::nullopt;
}

bool MapArrayPool::has_room(const MapBand& band) const {
  // No layer has room for what is wider or higher than all: the texture has to grow.
  return band.width > width_ || band.height > rows_ ||
         std::any_of(layers_.begin(), layers_.end(),
                     [&](const Spans& layer) { return layer.has(band.height); });
}

Status MapArrayPool::grow(std::uint32_t width, std::uint32_t rows, std::uint32_t more_layers,
                          std::optional<Texture>& texture) {
  width = std::max(width, width_);
  rows = std::max({rows, rows_, kFewestRows});
  const auto before = static_cast<std::uint32_t>(layers_.size());
  const auto most = static_cast<std::uint32_t>(get_limit(gl_, GL_MAX_ARRAY_TEXTURE_LAYERS));
  const auto largest = static_cast<std::uint32_t>(get_limit(gl_, GL_MAX_TEXTURE_SIZE));
  if (before + more_layers > most || std::max(width, rows) > largest) {
    return make_error(
        "the {} are larger than this OpenGL allows ({} texels a side, {} layers); give a smaller "
        "--gpu-memory",
        format_.label, largest, most);
  }
  const std::uint32_t layers = before + more_layers;
  RELIEF_TRY_ASSIGN(Texture larger, make_map_array(gl_, format_, {width, rows}, layers));
  if (texture && before > 0) {
    gl_.CopyImageSubData(texture->id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, larger.id(),
                         GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, static_cast<GLsizei>(width_),
                         static_cast<GLsizei>(rows_), static_cast<GLsizei>(before));
  }
  texture = std::move(larger);
  width_ = width;
  rows_ = rows;
  layers_.resize(layers);
  for (Spans& layer : layers_) layer.grow(rows);
  return {};
}

Result<bool> MapArrayPool::reserve(std::uint64_t bytes, std::optional<Texture>& texture) {
  if (bytes <= this->bytes()) return false;
  const auto divided = [](std::uint64_t a, std::uint64_t b) { return (a + b - 1) / b; };
  const std::uint64_t rows = divided(bytes, std::uint64_t{width_} * texel_bytes_);
  const std::uint64_t layers = std::max<std::uint64_t>(layers_.size(), divided(rows, kMostRows));
  RELIEF_TRY(grow(width_, static_cast<std::uint32_t>(divided(rows, layers)),
                  static_cast<std::uint32_t>(layers - layers_.size()), texture));
  return true;
}

Result<AtlasSpot> MapArrayPool::add(const MapBand& band, std::optional<Texture>& texture) {
  std::optional<AtlasSpot> spot;
  if (band.width <= width_) spot = find_room(band.height);
  if (!spot) {
    RELIEF_TRY(grow(band.width, band.height, 1, texture));
    spot = find_room(band.height);
  }
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_.TextureSubImage3D(texture->id(), 0, 0, static_cast<GLint>(spot->y),
                        static_cast<GLint>(spot->layer), static_cast<GLsizei>(band.width),
                        static_cast<GLsizei>(band.height), 1, format_.format, format_.type,
                        band.texels.data());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  return *spot;
}

void MapArrayPool::remove(const AtlasSpot& spot, std::uint32_t rows) {
  layers_[spot.layer].give(spot.y, rows);
}

}  // namespace relief

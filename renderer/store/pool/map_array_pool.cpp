#include "renderer/store/pool/map_array_pool.h"

#include <algorithm>
#include <span>
#include <utility>

namespace relief {
namespace {

/// Patches are rarely wider than so many columns, which would make the texture grow.
constexpr std::uint32_t kColumns = 8;
/// Of a layer that is made for a single band, unless that is higher.
constexpr std::uint32_t kFewestRows = 512;
/// Bands of a few hundred rows leave a gap in each layer: few high layers have few.
constexpr std::uint32_t kMostRows = 8192;

/// The first row from which on all of some columns have so many free.
std::optional<std::uint32_t> first_free(std::span<const Spans> columns, std::uint32_t rows) {
  std::optional<std::uint32_t> first;
  for (const Spans& column : columns) {
    for (const auto& [row, count] : column.gaps()) {
      if (first && row >= *first) break;
      if (count >= rows && std::ranges::all_of(columns, [row = row, rows](const Spans& other) {
            return other.has(row, rows);
          })) {
        first = row;
        break;
      }
    }
  }
  return first;
}

}  // namespace

std::uint64_t MapArrayPool::bytes() const {
  return std::uint64_t{columns_} * column_ * rows_ * layers_.size() * texel_bytes_;
}

std::optional<AtlasSpot> MapArrayPool::find_room(std::uint32_t width, std::uint32_t rows) const {
  const std::uint32_t wanted = columns_of(width);
  for (std::uint32_t layer = 0; layer < layers_.size(); ++layer) {
    for (std::uint32_t c = 0; c + wanted <= columns_; ++c) {
      if (const auto row = first_free(std::span(layers_[layer]).subspan(c, wanted), rows))
        return AtlasSpot{c * column_, *row, layer};
    }
  }
  return std::nullopt;
}

bool MapArrayPool::has_room(const MapBand& band) const {
  // No layer has room for what is wider or higher than all: the texture has to grow.
  return columns_of(band.width) > columns_ || band.height > rows_ ||
         find_room(band.width, band.height).has_value();
}

Status MapArrayPool::grow(std::uint32_t width, std::uint32_t rows, std::uint32_t more_layers,
                          std::optional<Texture>& texture) {
  const std::uint32_t columns = std::max({columns_of(width), columns_, kColumns});
  rows = std::max({rows, rows_, kFewestRows});
  const auto before = static_cast<std::uint32_t>(layers_.size());
  const std::uint32_t layers = before + more_layers;
  const auto most = static_cast<std::uint32_t>(get_limit(gl_, GL_MAX_ARRAY_TEXTURE_LAYERS));
  const auto largest = static_cast<std::uint32_t>(get_limit(gl_, GL_MAX_TEXTURE_SIZE));
  if (layers > most || std::max(columns * column_, rows) > largest) {
    return make_error(
        "the {} are larger than this OpenGL allows ({} texels a side, {} layers); give a smaller "
        "--gpu-memory",
        format_.label, largest, most);
  }
  RELIEF_TRY_ASSIGN(Texture larger,
                    make_map_array(gl_, format_, {columns * column_, rows}, layers));
  if (texture && before > 0) {
    gl_.CopyImageSubData(texture->id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, larger.id(),
                         GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, static_cast<GLsizei>(columns_ * column_),
                         static_cast<GLsizei>(rows_), static_cast<GLsizei>(before));
  }
  texture = std::move(larger);
  columns_ = columns;
  rows_ = rows;
  layers_.resize(layers);
  for (Layer& layer : layers_) {
    layer.resize(columns);
    for (Spans& column : layer) column.grow(rows);
  }
  return {};
}

Result<bool> MapArrayPool::reserve(std::uint64_t bytes, std::optional<Texture>& texture) {
  if (bytes <= this->bytes()) return false;
  const auto divided = [](std::uint64_t a, std::uint64_t b) { return (a + b - 1) / b; };
  const std::uint64_t width = std::uint64_t{std::max(columns_, kColumns)} * column_;
  const std::uint64_t rows = divided(bytes, width * texel_bytes_);
  const std::uint64_t layers = std::max<std::uint64_t>(layers_.size(), divided(rows, kMostRows));
  RELIEF_TRY(grow(0, static_cast<std::uint32_t>(divided(rows, layers)),
                  static_cast<std::uint32_t>(layers - layers_.size()), texture));
  return true;
}

Result<PlacedBand> MapArrayPool::add(const MapBand& band, std::optional<Texture>& texture) {
  std::optional<AtlasSpot> spot = find_room(band.width, band.height);
  if (!spot) {
    RELIEF_TRY(grow(band.width, band.height, 1, texture));
    spot = find_room(band.width, band.height);
  }
  const std::uint32_t first = spot->x / column_;
  for (std::uint32_t c = first; c < first + columns_of(band.width); ++c)
    layers_[spot->layer][c].take(spot->y, band.height);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_.TextureSubImage3D(texture->id(), 0, static_cast<GLint>(spot->x), static_cast<GLint>(spot->y),
                        static_cast<GLint>(spot->layer), static_cast<GLsizei>(band.width),
                        static_cast<GLsizei>(band.height), 1, format_.format, format_.type,
                        band.texels.data());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  return PlacedBand{*spot, band.width, band.height};
}

void MapArrayPool::remove(const PlacedBand& band) {
  const std::uint32_t first = band.spot.x / column_;
  for (std::uint32_t c = first; c < first + columns_of(band.width); ++c)
    layers_[band.spot.layer][c].give(band.spot.y, band.rows);
}

}  // namespace relief

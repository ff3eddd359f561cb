// An array texture whose maps come and go in bands.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/error.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/store/maps/map_bands.h"
#include "renderer/store/maps/map_upload.h"
#include "renderer/store/pool/spans.h"

namespace relief {

/// Where a band is.
struct PlacedBand {
  AtlasSpot spot;
  std::uint32_t width = 0;
  std::uint32_t rows = 0;
};

/// Keeps bands of maps in the layers of an array texture, which grows as needed; what is in it is
/// then copied, and stays where it is. A layer has columns, so that narrow bands lie side by side
/// and wide ones over several.
class MapArrayPool {
 public:
  /// `texel_bytes`: of a texel in the format. `column`: width of a column, that of most bands.
  MapArrayPool(const Gl& gl, const MapFormat& format, std::uint32_t texel_bytes,
               std::uint32_t column)
      : gl_(gl), format_(format), texel_bytes_(texel_bytes), column_(column) {}

  /// Uploads a band. Fails if OpenGL has no memory for it, or allows no array as large; then
  /// nothing has changed.
  Result<PlacedBand> add(const MapBand& band, std::optional<Texture>& texture);

  /// Whether add() would take the band without growing, or will grow whatever else is dropped.
  [[nodiscard]] bool has_room(const MapBand& band) const;

  /// Grows, if need be, to so many bytes. Returns whether it did. Fails as add() does.
  Result<bool> reserve(std::uint64_t bytes, std::optional<Texture>& texture);

  /// Gives back the place of a band.
  void remove(const PlacedBand& band);

  [[nodiscard]] std::uint64_t bytes() const;

 private:
  using Layer = std::vector<Spans>;  ///< rows of each column

  [[nodiscard]] std::uint32_t columns_of(std::uint32_t width) const {
    return (width + column_ - 1) / column_;
  }
  [[nodiscard]] std::optional<AtlasSpot> find_room(std::uint32_t width, std::uint32_t rows) const;
  Status grow(std::uint32_t width, std::uint32_t rows, std::uint32_t more_layers,
              std::optional<Texture>& texture);

  const Gl& gl_;
  MapFormat format_;
  std::uint32_t texel_bytes_;
  std::uint32_t column_;
  std::uint32_t columns_ = 0;
  std::uint32_t rows_ = 0;  ///< of a layer
  std::vector<Layer> layers_;
};

}  // namespace relief

// The points of each tile, and of its halo, as files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "common/error.h"
#include "common/points.h"
#include "preprocess/tiles/tile_layout.h"

namespace relief {

/// Where a halo's point is at home: the tile, and the point's number in that tile's file.
struct Home {
  std::uint32_t tile = 0;
  std::uint32_t point = 0;
};

/// Which attributes all of a scan's points have.
struct ScanAttributes {
  bool normals = false;
  bool colours = false;
};

/// A tile's points as its files have them.
struct TilePoints {
  Points points;           ///< the tile's own, then those of the halo
  std::size_t own = 0;     ///< this many are the tile's own
  std::vector<Home> home;  ///< of the halo's
};

/// How many points a tile's files have.
struct TileCount {
  std::uint64_t own = 0;
  std::uint64_t halo = 0;
};

/// Spreads points over the files of their tiles and of those whose halos they are in. What is in
/// memory is little and does not grow.
class TileWriter {
 public:
  /// `folder` must have none of the files yet. `layout` must stay as it is.
  TileWriter(std::filesystem::path folder, const TileLayout& layout, ScanAttributes attributes);

  /// `block` has the attributes; others are passed over. Fails if the disk is full.
  Status add(const Points& block);
  /// Writes what is left. Nothing may be added afterwards.
  Status finish();

  [[nodiscard]] const std::vector<TileCount>& counts() const { return counts_; }

 private:
  struct Part {
    std::filesystem::path path;
    std::vector<std::byte> buffer;
  };
  Status flush(Part& part);
  Status append(Part& part, const Points& block, std::size_t i, const Home* home);

  const TileLayout& layout_;
  ScanAttributes attributes_;
  std::size_t buffer_bytes_;
  std::vector<Part> own_;
  std::vector<Part> halo_;
  std::vector<TileCount> counts_;
};

/// Reads what TileWriter wrote of one tile.
Result<TilePoints> load_tile(const std::filesystem::path& folder, std::uint32_t tile,
                             TileCount count, ScanAttributes attributes);

/// Removes a tile's files, which are not needed any more.
void remove_tile(const std::filesystem::path& folder, std::uint32_t tile);

}  // namespace relief

// Files of the points of each tile and its halo.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "common/error.h"
#include "common/points.h"
#include "common/scalar.h"
#include "preprocess/tiles/tile_layout.h"

namespace relief {

/// The home of a halo's point: its tile, and its index in that tile's file.
struct Home {
  std::uint32_t tile = 0;
  std::uint32_t point = 0;
};

/// The attributes that all points of a scan have.
struct ScanAttributes {
  bool normals = false;
  bool colours = false;
  std::vector<ScalarInfo> scalars = {};
};

/// The points in a tile's files.
struct TilePoints {
  Points points;           ///< own points, then those of the halo
  std::size_t own = 0;     ///< number of own points
  std::vector<Home> home;  ///< of the halo's points
  /// New index of each point of the tile's own file once stray points were dropped, kNoPoint for
  /// these; empty: unchanged.
  std::vector<std::uint32_t> number;
  /// Positions as scanned, and normals as in SmoothPoints; empty if no noise was removed.
  std::vector<glm::dvec3> scanned;
  std::vector<glm::vec3> smooth_normals;
};

/// Returns the halo's points by the tile that is their home, each as its index in the halo.
[[nodiscard]] std::map<std::uint32_t, std::vector<std::size_t>> halo_by_home(
    const TilePoints& tile);

/// The number of points in a tile's files.
struct TileCount {
  std::uint64_t own = 0;
  std::uint64_t halo = 0;
};

/// Distributes points to the files of their tiles and of the tiles in whose halos they lie. Memory
/// stays small and constant.
class TileWriter {
 public:
  /// `folder` must not contain the files yet. `layout` must not change.
  TileWriter(std::filesystem::path folder, const TileLayout& layout, ScanAttributes attributes);

  /// `block` has the attributes, and just their scalars, in their order; others are ignored. Fails
  /// if the disk is full.
  Status add(const Points& block);
  /// Writes the remaining points. Nothing may be added afterwards.
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

/// Reads the files of one tile.
Result<TilePoints> load_tile(const std::filesystem::path& folder, std::uint32_t tile,
                             TileCount count, const ScanAttributes& attributes);

/// Removes the files of a tile.
void remove_tile(const std::filesystem::path& folder, std::uint32_t tile);

}  // namespace relief

// Which chunks of a file with tiles are drawn, and which are to be read next.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "common/bounds.h"
#include "common/patch_file/tree_tile.h"
#include "loader/stream/chunks.h"

namespace relief {

/// Tiles between those without a parent and those that a view is to show.
struct TilePath {
  std::vector<std::uint32_t> tiles;  ///< parents before their children
  std::vector<bool> is_end;          ///< by position in `tiles`: it is to be shown itself
};

/// Returns the path to tiles that choose_tiles() (renderer/view/patches_in_view.h) has chosen.
[[nodiscard]] TilePath path_to(std::span<const TreeTile> tiles,
                               std::span<const std::uint32_t> chosen);

/// What a cut needs to know of the view and of what is there.
struct CutState {
  /// What is known of a tile's chunks; null: its index has not been read.
  std::function<const TileIndex*(std::uint32_t tile)> index;
  /// The finest level of a chunk that can be drawn; none: nothing of it.
  std::function<std::optional<std::uint32_t>(ChunkKey key)> finest;
  /// The finest level that the view shows of a chunk.
  std::function<std::uint32_t(const ChunkInfo& chunk)> needed;
  /// Whether the view may show samples in a box, which are `spacing` apart.
  std::function<bool(const Bounds& box, double spacing)> sees;
  /// How far a box is from the eye.
  std::function<double(const Bounds& box)> distance;
};

/// A chunk that is drawn.
struct CutPart {
  ChunkKey key;
  /// It stands in for what is missing in these boxes: patches that reach into one are drawn. Empty:
  /// it is to be shown itself, whole.
  std::vector<Bounds> gaps = {};

  [[nodiscard]] bool operator==(const CutPart& other) const;
};

/// Something to be read: a chunk, or a tile's index.
struct Want {
  std::uint32_t tile = 0;
  std::optional<std::uint32_t> chunk;
  std::uint32_t finest = 0;  ///< level of the chunk

  bool operator==(const Want&) const = default;
};

struct Cut {
  std::vector<CutPart> shown;
  std::vector<ChunkKey> seen;  ///< chunks of the path in view, there or not
  /// Of them, those that are not there, or not as fine as needed: coarse tiles first, near ones
  /// first.
  std::vector<Want> wanted;
};

/// Chunks are read from this level on unless finer ones are needed: a tile whose samples are seen a
/// pixel apart is drawn at four pixels a sample (kPixelsPerSampleOfCells). Preparing the finer ones
/// takes half of the time.
inline constexpr std::uint32_t kUsualFinest = 2;

/// Chooses what is drawn now. Where chunks that the view is to show are missing, what is there of
/// their tiles' ancestors stands in. Nothing covers a region twice but in the boxes of what is
/// missing.
[[nodiscard]] Cut make_cut(std::span<const TreeTile> tiles, const TilePath& path,
                           const CutState& state);

/// Whether two boxes have points in common.
[[nodiscard]] bool overlap(const Bounds& a, const Bounds& b);

}  // namespace relief

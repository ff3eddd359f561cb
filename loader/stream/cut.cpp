#include "loader/stream/cut.h"

#include <algorithm>
#include <glm/vector_relational.hpp>
#include <iterator>
#include <map>
#include <utility>

namespace relief {
namespace {

Bounds enlarged(const Bounds& box, double by) {
  return {box.min - by, box.max + by};
}

bool overlaps_any(const Bounds& box, std::span<const Bounds> boxes) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const Bounds& b) { return overlap(box, b); });
}

class CutMaker {
 public:
  CutMaker(std::span<const TreeTile> tiles, const CutState& state) : tiles_(tiles), state_(state) {}

  /// `gaps`: what its children on the path lack; none if it is shown itself.
  /// Returns what the tile's parent has to stand in for.
  std::vector<Bounds> add(std::uint32_t t, bool is_end, std::vector<Bounds> gaps) {
    const TileIndex* const index = state_.index(t);
    if (index == nullptr) {
      want({t, std::nullopt, 0}, tiles_[t].box);
      if (is_end) gaps.push_back(tiles_[t].box);
      return gaps;
    }
    std::vector<Bounds> missing;
    for (std::uint32_t c = 0; c < index->chunks.size(); ++c) {
      const ChunkInfo& chunk = index->chunks[c];
      if (!state_.sees(chunk.box, chunk.spacing)) continue;
      const ChunkKey key{t, c};
      cut_.seen.push_back(key);
      const std::optional<std::uint32_t> finest = state_.finest(key);
      const std::uint32_t needed = is_end ? state_.needed(chunk) : kUsualFinest;
      if (!finest || *finest > needed) want({t, c, needed}, chunk.box);
      if (!finest) {
        missing.push_back(chunk.box);
      } else if (is_end) {
        cut_.shown.push_back({key});
      } else if (std::vector<Bounds> filled = gaps_in(chunk, gaps); !filled.empty()) {
        cut_.shown.push_back({key, std::move(filled)});
      }
    }
    if (is_end) return missing;
    // What the tile's own missing chunks would have stood in for is left to its parent.
    std::erase_if(gaps, [&](const Bounds& gap) { return !overlaps_any(gap, missing); });
    return gaps;
  }

  Cut take() {
    std::stable_sort(order_.begin(), order_.end(), [](const Order& a, const Order& b) {
      return std::pair(-static_cast<int>(a.level), a.distance) <
             std::pair(-static_cast<int>(b.level), b.distance);
    });
    for (const Order& one : order_) cut_.wanted.push_back(one.want);
    return std::move(cut_);
  }

 private:
  struct Order {
    Want want;
    std::uint32_t level = 0;
    double distance = 0.0;
  };

  void want(Want want, const Bounds& box) {
    order_.push_back({want, tiles_[want.tile].level, state_.distance(box)});
  }

  /// A coarser surface lies where the finer one does to within about its spacing.
  static std::vector<Bounds> gaps_in(const ChunkInfo& chunk, std::span<const Bounds> gaps) {
    std::vector<Bounds> filled;
    const Bounds reach = enlarged(chunk.box, chunk.spacing);
    for (const Bounds& gap : gaps) {
      if (overlap(gap, reach)) filled.push_back(enlarged(gap, chunk.spacing));
    }
    return filled;
  }

  std::span<const TreeTile> tiles_;
  const CutState& state_;
  Cut cut_;
  std::vector<Order> order_;
};

}  // namespace

bool CutPart::operator==(const CutPart& other) const {
  return key == other.key && std::equal(gaps.begin(), gaps.end(), other.gaps.begin(),
                                        other.gaps.end(), [](const Bounds& a, const Bounds& b) {
                                          return a.min == b.min && a.max == b.max;
                                        });
}

bool overlap(const Bounds& a, const Bounds& b) {
  return !a.empty() && !b.empty() && glm::all(glm::lessThanEqual(a.min, b.max)) &&
         glm::all(glm::lessThanEqual(b.min, a.max));
}

TilePath path_to(std::span<const TreeTile> tiles, std::span<const std::uint32_t> chosen) {
  std::map<std::uint32_t, bool> on_path;  // whether it is an end
  for (const std::uint32_t end : chosen) {
    on_path[end] = true;
    for (std::uint32_t t = tiles[end].parent; t != kNoTile; t = tiles[t].parent) {
      if (!on_path.try_emplace(t, false).second) break;
    }
  }
  TilePath path;
  for (const auto& [tile, is_end] : on_path) {
    path.tiles.push_back(tile);
    path.is_end.push_back(is_end);
  }
  return path;
}

Cut make_cut(std::span<const TreeTile> tiles, const TilePath& path, const CutState& state) {
  CutMaker maker(tiles, state);
  std::map<std::uint32_t, std::vector<Bounds>> gaps;
  for (std::size_t k = path.tiles.size(); k-- > 0;) {
    const std::uint32_t t = path.tiles[k];
    const std::vector<Bounds> left = maker.add(t, path.is_end[k], std::move(gaps[t]));
    if (tiles[t].parent == kNoTile) continue;
    std::vector<Bounds>& of_parent = gaps[tiles[t].parent];
    of_parent.insert(of_parent.end(), left.begin(), left.end());
  }
  return maker.take();
}

}  // namespace relief

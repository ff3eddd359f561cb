// What is drawn while parts of a file are missing.
#include "loader/stream/cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace relief {
namespace {

/// A line of eight tiles from x = 0 to 8, over them four, two and one; each tile has four chunks
/// side by side.
class Cuts : public testing::Test {
 protected:
  Cuts() {
    std::uint32_t above = kNoTile;
    for (std::uint32_t level = 3; level <= 3; --level) {
      const auto first = static_cast<std::uint32_t>(tiles_.size());
      for (std::uint32_t k = 0; k < 8U >> level; ++k) {
        TreeTile tile;
        tile.level = level;
        tile.parent = above == kNoTile ? kNoTile : above + k / 2;
        tile.spacing = 0.001 * (1U << level);
        tile.samples = 1000;
        const double size = 1U << level;
        tile.box = {{size * k, 0.0, 0.0}, {size * (k + 1), 1.0, 1.0}};
        TileIndex index;
        for (int c = 0; c < 4; ++c) {
          ChunkInfo chunk;
          chunk.box = {{size * (k + 0.25 * c), 0.0, 0.0}, {size * (k + 0.25 * (c + 1)), 1.0, 1.0}};
          chunk.spacing = tile.spacing;
          index.chunks.push_back(chunk);
        }
        tiles_.push_back(tile);
        indices_.push_back(index);
      }
      above = first;
    }
  }

  /// All tiles of a level are to be shown, of which the view sees x = `from_` to `to_`.
  Cut cut(std::uint32_t level) {
    std::vector<std::uint32_t> chosen;
    for (std::uint32_t t = 0; t < tiles_.size(); ++t) {
      if (tiles_[t].level == level && sees(tiles_[t].box)) chosen.push_back(t);
    }
    const CutState state{
        .index = [this](std::uint32_t t) { return unknown_.contains(t) ? nullptr : &indices_[t]; },
        .finest = [this](ChunkKey key) -> std::optional<std::uint32_t> {
          const auto found = there_.find(key);
          return found == there_.end() ? std::nullopt : std::optional(found->second);
        },
        .needed = [this](const ChunkInfo&) { return needed_; },
        .sees = [this](const Bounds& box, double) { return sees(box); },
        .distance = [this](const Bounds& box) { return std::abs(box.min.x - eye_); }};
    return make_cut(tiles_, path_to(tiles_, chosen), state);
  }
  [[nodiscard]] bool sees(const Bounds& box) const { return box.min.x < to_ && box.max.x > from_; }

  void add(std::uint32_t tile) {
    for (std::uint32_t c = 0; c < 4; ++c) there_[{tile, c}] = 0;
  }

  /// Whether something is drawn at x; with `exactly`, a single thing.
  [[nodiscard]] bool covers(const Cut& cut, double x, bool exactly = false) const {
    int times = 0;
    for (const CutPart& part : cut.shown) {
      const Bounds& box = indices_[part.key.tile].chunks[part.key.chunk].box;
      if (x <= box.min.x || x >= box.max.x) continue;
      const bool is_in_gap =
          part.gaps.empty() || std::ranges::any_of(part.gaps, [x](const Bounds& gap) {
            return x >= gap.min.x && x <= gap.max.x;
          });
      times += is_in_gap ? 1 : 0;
    }
    return exactly ? times == 1 : times > 0;
  }

  std::vector<TreeTile> tiles_;
  std::vector<TileIndex> indices_;
  std::set<std::uint32_t> unknown_;
  std::map<ChunkKey, std::uint32_t> there_;
  std::uint32_t needed_ = kUsualFinest;
  double from_ = 0.0;
  double to_ = 8.0;
  double eye_ = 0.0;
};

TEST_F(Cuts, PathsLeadFromTheCoarsestTileToTheChosenOnes) {
  const std::vector<std::uint32_t> chosen{7, 2};
  const TilePath path = path_to(tiles_, chosen);
  EXPECT_EQ(path.tiles, (std::vector<std::uint32_t>{0, 1, 2, 3, 7}));
  EXPECT_EQ(path.is_end, (std::vector<bool>{false, false, true, false, true}));
}

TEST_F(Cuts, ShowTheChosenTilesAloneOnceTheyAreThere) {
  for (std::uint32_t t = 0; t < tiles_.size(); ++t) add(t);
  const Cut all = cut(0);
  EXPECT_TRUE(all.wanted.empty());
  EXPECT_EQ(all.shown.size(), 32U);
  for (const CutPart& part : all.shown) {
    EXPECT_EQ(tiles_[part.key.tile].level, 0U);
    EXPECT_TRUE(part.gaps.empty());
  }
}

TEST_F(Cuts, LetTheCoarsestTileStandInForEverything) {
  add(0);
  const Cut first = cut(0);
  for (double x = 0.1; x < 8.0; x += 0.2) EXPECT_TRUE(covers(first, x)) << x;
  EXPECT_EQ(first.shown.size(), 4U);
  // Coarse tiles are read first, so that what stands in gets finer.
  ASSERT_EQ(first.wanted.size(), 14U * 4U);
  for (std::size_t k = 1; k < first.wanted.size(); ++k)
    EXPECT_LE(tiles_[first.wanted[k].tile].level, tiles_[first.wanted[k - 1].tile].level);
}

TEST_F(Cuts, KeepWhatIsFineWhereItsNeighboursAreMissing) {
  for (std::uint32_t t = 0; t < tiles_.size(); ++t) add(t);
  // A camera that moves sees a chunk that is not there, amid those that are.
  there_.erase({10, 1});
  const Cut moved = cut(0);
  EXPECT_EQ(moved.wanted, (std::vector<Want>{{10, 1, kUsualFinest}}));
  std::size_t stand_ins = 0;
  for (const CutPart& part : moved.shown) {
    if (part.gaps.empty()) continue;
    ++stand_ins;
    EXPECT_EQ(part.key.tile, tiles_[10].parent) << "the finest that is there";
  }
  EXPECT_GE(stand_ins, 1U);
  const Bounds& gap = indices_[10].chunks[1].box;
  for (double x = 0.01; x < 8.0; x += 0.05) {
    const bool is_beside = x < gap.min.x - 0.1 || x > gap.max.x + 0.1;
    EXPECT_TRUE(covers(moved, x, is_beside)) << x;
  }
}

TEST_F(Cuts, ReadTheIndexOfATileBeforeItsChunks) {
  add(0);
  unknown_ = {1, 2};
  const Cut first = cut(1);
  EXPECT_EQ(first.wanted.front(), (Want{1, std::nullopt, 0}));
  EXPECT_EQ(first.wanted[1], (Want{2, std::nullopt, 0}));
  for (double x = 0.1; x < 8.0; x += 0.2) EXPECT_TRUE(covers(first, x)) << x;
}

TEST_F(Cuts, ReadNearChunksFirstAndNothingOutOfView) {
  add(0);
  from_ = 2.0;
  to_ = 4.0;
  eye_ = 3.9;
  const Cut near = cut(0);
  EXPECT_EQ(near.wanted.back().tile, 9U) << "from x = 2 to 3";
  for (const Want& want : near.wanted)
    EXPECT_TRUE(sees(indices_[want.tile].chunks[*want.chunk].box));
  std::vector<std::uint32_t> finest;
  for (const Want& want : near.wanted) {
    if (tiles_[want.tile].level == 0) finest.push_back(want.tile);
  }
  ASSERT_EQ(finest.size(), 8U);
  EXPECT_EQ(finest.front(), 10U) << "from x = 3 to 4";
}

TEST_F(Cuts, ReadChunksAgainThatAreNotFineEnough) {
  for (std::uint32_t t = 0; t < tiles_.size(); ++t) add(t);
  there_[{7, 0}] = kUsualFinest;
  EXPECT_TRUE(cut(0).wanted.empty());
  needed_ = 0;
  const Cut closer = cut(0);
  EXPECT_EQ(closer.wanted, (std::vector<Want>{{7, 0, 0}}));
  EXPECT_EQ(closer.shown.size(), 32U) << "until then it is shown as it is";
}

TEST_F(Cuts, NeverHaveAHoleWhateverIsThere) {
  std::mt19937 random(3);
  for (int round = 0; round < 500; ++round) {
    there_.clear();
    unknown_.clear();
    add(0);
    for (std::uint32_t t = 1; t < tiles_.size(); ++t) {
      if (random() % 4 == 0) unknown_.insert(t);
      for (std::uint32_t c = 0; c < 4; ++c) {
        if (random() % 2 == 0) there_[{t, c}] = 0;
      }
    }
    from_ = 0.01 * static_cast<double>(random() % 500);
    to_ = from_ + 3.0;
    const Cut some = cut(random() % 3);
    for (double x = from_ + 0.0013; x < to_; x += 0.07)
      ASSERT_TRUE(covers(some, x)) << "round " << round << " x " << x;
  }
}

}  // namespace
}  // namespace relief

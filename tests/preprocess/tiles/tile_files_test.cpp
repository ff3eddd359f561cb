#include "preprocess/tiles/tile_files.h"

#include <gtest/gtest.h>

#include "preprocess/tiles/checkpoint.h"
#include "preprocess/tiles/survey.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

using test::ScratchFolder;
using test::slurp;
using test::spill;

TEST(TileFiles, GiveEachTileItsPointsAndItsHalo) {
  const ScratchFolder folder;
  Points points = test::sample_sphere(5000);
  for (const glm::dvec3& p : points.positions) {
    points.normals.emplace_back(p);
    points.colours.emplace_back(100.0 + 100.0 * p);
  }
  PointSample sample;
  for (const glm::dvec3& p : points.positions) sample.add(p);
  const TileLayout layout = lay_tiles(sample, 1000, 0.0);
  TileWriter writer(folder.path(), layout, {true, true});
  ASSERT_TRUE(writer.add(points));
  ASSERT_TRUE(writer.finish());

  std::vector<TilePoints> tiles;
  std::size_t own = 0;
  for (std::uint32_t t = 0; t < layout.tiles.size(); ++t) {
    auto tile = load_tile(folder.path(), t, writer.counts()[t], {true, true});
    ASSERT_TRUE(tile) << tile.error().message;
    tiles.push_back(std::move(*tile));
    own += tiles.back().own;
  }
  EXPECT_EQ(own, points.size());
  for (std::uint32_t t = 0; t < tiles.size(); ++t) {
    const TilePoints& tile = tiles[t];
    EXPECT_GT(tile.home.size(), 0U);
    ASSERT_EQ(tile.points.size(), tile.own + tile.home.size());
    for (std::size_t i = 0; i < tile.points.size(); ++i) {
      const glm::dvec3 p = tile.points.positions[i];
      EXPECT_EQ(layout.tile_of(p) == t, i < tile.own);
      EXPECT_EQ(tile.points.normals[i], glm::vec3(p));
      EXPECT_EQ(tile.points.colours[i], glm::u8vec3(100.0 + 100.0 * p));
    }
    for (std::size_t h = 0; h < tile.home.size(); ++h) {
      const Home home = tile.home[h];
      EXPECT_EQ(tiles[home.tile].points.positions[home.point], tile.points.positions[tile.own + h]);
    }
  }
}

TEST(TileFiles, DuplicatesAreMergedAndHomesStayRight) {
  TilePoints tile;
  tile.points.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {2, 0, 0},
                           {3, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  tile.own = 4;
  tile.home = {{1, 10}, {1, 11}, {2, 12}};
  const std::vector<std::uint32_t> number = merge_duplicates(tile);
  const std::vector<std::uint32_t> expected{0, 1, 0, 2};
  EXPECT_EQ(number, expected);
  EXPECT_EQ(tile.own, 3U);
  ASSERT_EQ(tile.home.size(), 2U);
  EXPECT_EQ(tile.home[0].point, 10U);
  EXPECT_EQ(tile.home[1].point, 12U);
  EXPECT_EQ(tile.points.positions[3], glm::dvec3(3, 0, 0));
  EXPECT_TRUE(merge_duplicates(tile).empty());
}

TEST(StateFile, DamageIsFound) {
  const ScratchFolder folder;
  StateWriter writer;
  writer.put(std::vector<float>{1.0F, 2.0F});
  writer.put(7.5);
  ASSERT_TRUE(writer.save(folder / "a"));
  const std::string good = slurp(folder / "a");
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 1);
    spill(folder / "b", bad);
    EXPECT_FALSE(StateReader::open(folder / "b")) << i;
    spill(folder / "b", good.substr(0, i));
    EXPECT_FALSE(StateReader::open(folder / "b")) << i;
  }
  auto reader = StateReader::open(folder / "a");
  ASSERT_TRUE(reader);
  std::vector<float> list;
  double number = 0.0;
  ASSERT_TRUE(reader->take(list) && reader->take(number));
  EXPECT_EQ(list, (std::vector<float>{1.0F, 2.0F}));
  EXPECT_EQ(number, 7.5);
  EXPECT_FALSE(reader->take(number));
}

}  // namespace
}  // namespace relief

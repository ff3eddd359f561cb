// FLIP is computed only about differences: its map must be that of a computation everywhere.
#include "common/compare/flip_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "common/compare/flip_filters.h"
#include "common/compare/flip_ldr.h"
#include "tests/common/compare/images.h"

namespace relief {
namespace {

using test::image_of;

constexpr int kWidth = 600;
constexpr int kHeight = 150;

using Pixels = std::vector<std::pair<int, int>>;

/// Places of different pixels: none, corners, rims, far apart, where tiles meet, and as far from
/// there as filters reach, 10 pixels, and one more.
const std::vector<Pixels> kPlaces = {
    {},
    {{0, 0}},
    {{kWidth - 1, kHeight - 1}},
    {{0, kHeight - 1}, {kWidth - 1, 0}},
    {{300, 0}},
    {{kWidth - 1, 70}},
    {{20, 10}, {570, 140}},
    {{255, 63}},
    {{256, 64}},
    {{246, 54}, {265, 73}},
    {{245, 53}, {266, 74}},
};

/// Light that no two places share; pixels at `places` have another colour.
LinearColour pattern(const Pixels& places) {
  return *take_colour(image_of(kWidth, kHeight, [&](int x, int y) {
    const bool other = std::find(places.begin(), places.end(), std::pair(x, y)) != places.end();
    const glm::vec3 colour(0.01F * static_cast<float>((7 * x + 3 * y) % 41),
                           0.02F * static_cast<float>((x * y) % 17),
                           0.1F * static_cast<float>((x + y) % 5));
    return other ? glm::vec3(1.0F, 0.5F, 2.0F) - colour : colour;
  }));
}

std::vector<float> flip_within(const std::vector<FlipTile>& tiles, const LinearColour& test,
                               const LinearColour& reference, std::optional<double> exposure,
                               const FlipFilters& filters) {
  std::vector<float> map(test.rgb[0].size());
  Progress progress;
  raise_to_ldr_flip(test, reference, exposure, filters, tiles, map, progress);
  return map;
}

TEST(FlipTiles, GiveTheMapOfTheWholeImage) {
  const std::vector<FlipTile> whole = {{0, 0, kWidth, kHeight}};
  const FlipFilters filters = make_flip_filters(kFlipPixelsPerDegree);
  const LinearColour reference = pattern({});
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    const LinearColour test = pattern(kPlaces[i]);
    const auto tiles = find_differing_tiles(test, reference, reach_of(filters));
    for (const std::optional<double> exposure : {std::optional<double>(), std::optional(-1.5)}) {
      const auto map = flip_within(whole, test, reference, exposure, filters);
      EXPECT_EQ(flip_within(tiles, test, reference, exposure, filters), map) << i;
      EXPECT_EQ(*std::max_element(map.begin(), map.end()) == 0.0F, kPlaces[i].empty()) << i;
    }
    Progress progress;
    const auto flip = measure_flip(test, reference, {FlipRange::Ldr}, progress);
    ASSERT_TRUE(flip);
    EXPECT_EQ(flip->map, flip_within(whole, test, reference, {}, filters)) << i;
  }
}

TEST(FlipTiles, HoldEveryPixelWithinReachOnce) {
  constexpr int kReach = 10;
  const LinearColour reference = pattern({});
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    std::vector<int> held(std::size_t{kWidth} * kHeight);
    for (const FlipTile& tile : find_differing_tiles(pattern(kPlaces[i]), reference, kReach)) {
      ASSERT_GT(tile.width * tile.height, 0U) << i;
      ASSERT_LE(tile.x + tile.width, std::uint32_t{kWidth}) << i;
      ASSERT_LE(tile.y + tile.height, std::uint32_t{kHeight}) << i;
      for (std::size_t y = tile.y; y < tile.y + tile.height; ++y) {
        for (std::size_t x = tile.x; x < tile.x + tile.width; ++x) ++held[y * kWidth + x];
      }
    }
    EXPECT_LE(*std::max_element(held.begin(), held.end()), 1) << i;
    for (const auto& [px, py] : kPlaces[i]) {
      for (int y = std::max(0, py - kReach); y <= std::min(kHeight - 1, py + kReach); ++y) {
        for (int x = std::max(0, px - kReach); x <= std::min(kWidth - 1, px + kReach); ++x) {
          ASSERT_EQ(held[static_cast<std::size_t>(y * kWidth + x)], 1) << i << " " << x << " " << y;
        }
      }
    }
    // They hold no more than the squares about the pixels, wherever tiles meet.
    const auto square = (2 * std::size_t{kReach} + 1) * (2 * std::size_t{kReach} + 1);
    const auto count = static_cast<std::size_t>(std::count(held.begin(), held.end(), 1));
    if (kPlaces[i].size() < 2) {
      EXPECT_LE(count, kPlaces[i].size() * square) << i;
    }
  }
}

}  // namespace
}  // namespace relief

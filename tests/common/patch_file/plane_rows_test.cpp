// Codec 1 of the patch file: heights that are set many at a time, and streams of residuals.
#include "common/patch_file/fast/plane_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "common/patch.h"
#include "common/patch_file/fast/patch_codec.h"
#include "common/patch_file/fast/residuals.h"

namespace relief {
namespace {

/// Holes of a chance of 1 / `kept_of` at each node; 1 leaves none but those of every third row's
/// end.
std::vector<std::uint8_t> some_mask(std::size_t width, std::size_t height, unsigned kept_of,
                                    std::mt19937& random) {
  std::vector<std::uint8_t> mask(width * height);
  for (std::size_t k = 0; k < mask.size(); ++k) {
    const bool is_hole =
        kept_of == 1 ? k / width % 3 == 0 && k % width + 2 >= width : random() % kept_of == 0;
    mask[k] = is_hole ? 0 : 1;
  }
  return mask;
}

/// Against prediction node by node: stretches that begin, end and stop at all positions of a block
/// and of a word, and values that wrap around.
TEST(UndoPlane, SetsWhatNodeByNodeSets) {
  std::mt19937 random(7);
  for (std::size_t width = 1; width < 45; ++width) {
    for (const unsigned kept_of : {1U, 2U, 5U, 30U}) {
      const std::size_t height = 1 + random() % 9;
      const std::vector<std::uint8_t> mask = some_mask(width, height, kept_of, random);
      const KeptGrid grid{width, height, mask};
      std::vector<std::uint16_t> residuals(count_marked(mask));
      for (std::uint16_t& r : residuals) r = static_cast<std::uint16_t>(random());
      std::vector<std::int32_t> wanted(mask.size(), kHole);
      undo_predicted(
          grid, residuals, predict_plane, [](std::uint16_t v) { return std::int32_t{v}; }, wanted);

      std::vector<std::uint16_t> differences(residuals.size() + kDifferencePadding);
      std::transform(residuals.begin(), residuals.end(), differences.begin(), unzigzag);
      std::vector<std::int32_t> values(mask.size());
      const bool has_most = undo_plane(grid, differences, kHole, values);
      ASSERT_EQ(values, wanted) << width << 'x' << height;
      ASSERT_EQ(has_most, std::find(wanted.begin(), wanted.end(), 65535) != wanted.end());
    }
  }
}

TEST(UndoPlane, Reports65535OnlyAtSamples) {
  const std::vector<std::uint8_t> mask{1, 0, 1};
  std::vector<std::int32_t> values(mask.size());
  std::vector<std::uint16_t> differences(2 + kDifferencePadding);
  // Node 1 is a hole, and what differences say behind the last one is no matter.
  differences[0] = 65534;
  differences[2] = 1;
  EXPECT_FALSE(undo_plane({3, 1, mask}, differences, kHole, values));
  EXPECT_EQ(values, (std::vector<std::int32_t>{65534, kHole, 65534}));
  differences[1] = 1;
  EXPECT_TRUE(undo_plane({3, 1, mask}, differences, kHole, values));
}

/// More nodes than sums of bytes hold.
TEST(CountMarked, CountsAll) {
  for (const std::size_t size : {0U, 1U, 15U, 16U, 4080U, 4096U, 10007U}) {
    std::vector<std::uint8_t> mask(size, 1);
    ASSERT_EQ(count_marked(mask), size);
    for (std::size_t k = 0; k < size; k += 7) mask[k] = 0;
    ASSERT_EQ(count_marked(mask), size - (size + 6) / 7);
  }
}

/// What repeats is still searched for: steps of a staircase in 1000 periods of 40 numbers.
TEST(Residuals, OfStepsTakeNextToNothing) {
  std::vector<std::uint16_t> residuals(40000);
  for (std::size_t k = 0; k < residuals.size(); k += 40) {
    residuals[k] = 3;
    residuals[k + 7] = 2;
  }
  ZstdContexts zstd;
  std::vector<std::byte> bytes;
  append_residuals(bytes, residuals, zstd);
  // zstd's level 9 takes 25 bytes and 8 for the streams' sizes; Huffman's code without matches
  // 5000.
  EXPECT_LT(bytes.size(), 100U);
  ByteReader in(bytes);
  const auto back = take_residuals(in, residuals.size(), zstd);
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, residuals);
}

/// What is noise is not: chance repetitions cost more than they save.
TEST(Residuals, OfNoiseTakeTheirEntropy) {
  std::mt19937 random(1);
  std::binomial_distribution<int> noise(24, 0.5);
  std::vector<std::uint16_t> residuals(2000);
  for (std::uint16_t& r : residuals) r = zigzag(static_cast<std::uint16_t>(noise(random) - 12));
  ZstdContexts zstd;
  std::vector<std::byte> bytes;
  append_residuals(bytes, residuals, zstd);
  // The bytes as an ordinary stream of zstd's level 9.
  const std::vector<std::uint8_t> low(residuals.begin(), residuals.end());
  std::vector<std::byte> searched;
  append_stream(searched, low, zstd);
  // 888 and 959 bytes; the entropy is 835.
  EXPECT_LT(static_cast<double>(bytes.size()), 0.95 * static_cast<double>(searched.size()));
}

}  // namespace
}  // namespace relief

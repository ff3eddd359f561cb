// Codec 2 of the patch file: entropy coding, masks, heights, maps and positions.
#include <gtest/gtest.h>

#include <glm/trigonometric.hpp>
#include <numeric>

#include "common/patch_file/compact/compact_codec.h"
#include "common/patch_file/compact/compact_mask.h"
#include "common/patch_file/compact/height_predictor.h"
#include "common/patch_file/compact/residual_classes.h"
#include "common/patch_file/compact/rotation_code.h"
#include "common/patch_file/fast/patch_codec.h"
#include "common/patch_file/patch_file.h"
#include "tests/common/patch_file/read_whole.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

using test::bumpy_model;
using test::bumpy_patch;
using test::PatchShape;
using test::read_whole;
using test::ScratchFolder;

TEST(Rans, GivesBackIntervalsAndBits) {
  std::mt19937 random(3);
  RansEncoder out;
  std::vector<std::uint32_t> bits;
  for (unsigned k = 0; k < 20000; ++k) {
    const unsigned count = k % 17;
    bits.push_back(random() & ((1U << count) - 1U));
    out.put_bits(bits.back(), count);
    // One of 4096 and 4095 of 4096.
    out.put(k % 3 == 0 ? Interval{4095, 1} : Interval{0, 4095});
  }
  std::vector<std::byte> bytes;
  out.finish(bytes);
  RansDecoder in(bytes);
  for (unsigned k = 0; k < 20000; ++k) {
    ASSERT_EQ(in.take_bits(k % 17), bits[k]) << k;
    ASSERT_EQ(in.peek() == 4095, k % 3 == 0) << k;
    in.advance(k % 3 == 0 ? Interval{4095, 1} : Interval{0, 4095});
  }
  EXPECT_TRUE(in.is_at_end());
  in.advance({0, 1});
  in.advance({0, 1});
  EXPECT_FALSE(in.is_sound());
}

TEST(ResidualClasses, CoverAllNumbersAndKeepEveryResidual) {
  for (unsigned n = 0; n < kResidualClasses; ++n) {
    const ResidualClasses& classes = residual_classes();
    std::uint32_t next = 0;
    for (unsigned s = 0; s <= classes.escape[n]; ++s) {
      ASSERT_EQ(classes.intervals[n][s].start, next) << n;
      next += classes.intervals[n][s].width;
    }
    ASSERT_EQ(next, kProbabilityOne) << n;

    RansEncoder out;
    const auto residual_of = [](std::uint32_t k) { return static_cast<std::uint16_t>(k); };
    for (std::uint32_t k = 0; k < 65536; k += k < 300 ? 1 : 97)
      put_residual(out, n, residual_of(k));
    put_residual(out, n, 65535);
    std::vector<std::byte> bytes;
    out.finish(bytes);
    RansDecoder in(bytes);
    for (std::uint32_t k = 0; k < 65536; k += k < 300 ? 1 : 97) {
      ASSERT_EQ(take_residual(in, classes, n), k) << n;
    }
    ASSERT_EQ(take_residual(in, classes, n), 65535) << n;
    ASSERT_TRUE(in.is_at_end()) << n;
  }
}

TEST(ResidualClasses, AreQuartersOfOctaves) {
  EXPECT_EQ(class_of(0), 0U);
  EXPECT_EQ(class_of(8), 0U);  // 1 / 32
  EXPECT_EQ(class_of(9), 0U);
  EXPECT_EQ(class_of(10), 1U);
  EXPECT_EQ(class_of(16), 4U);
  EXPECT_EQ(class_of(256), 20U);  // 1
  EXPECT_EQ(class_of(0xFFFFFFFF), kResidualClasses - 1);
  for (std::uint32_t e = 0; e < 100000; ++e) {
    ASSERT_EQ(residual_classes().number_of(e), class_of(e)) << e;
  }
}

/// What the document says of the tables, and what keeps sums of heights within 32 bits.
TEST(HeightPredictor, HasARowForAllThatMayBeKnown) {
  for (const PredictorTable* table : {&predictor_tables().rows, &predictor_tables().columns}) {
    for (std::uint32_t known = 0; known < 1024; ++known) {
      const PredictorRow& row = table->row(known);
      ASSERT_EQ(row.known & ~known, 0U) << known;
      int sum = 0;
      int magnitude = 0;
      for (std::size_t k = 0; k < kMaxNeighbours; ++k) {
        if ((row.known >> k & 1U) == 0) {
          ASSERT_EQ(row.weights[k], 0) << known;
        }
        sum += row.weights[k];
        magnitude += std::abs(row.weights[k]);
      }
      if (row.known != 0) {
        ASSERT_EQ(sum, 1 << kWeightBits) << known;
      }
      ASSERT_LE(magnitude * 65535.0, 2147483647.0 - 512.0) << known;
    }
  }
}

TEST(RotationCode, IsNearEveryRotation) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 1000; ++k) {
    const glm::dvec3 z = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const glm::dvec3 x =
        glm::normalize(glm::cross(z, glm::dvec3(normal(random), normal(random), normal(random))));
    const glm::dmat3 axes(x, glm::cross(z, x), z);
    const RotationCode code = encode_rotation(axes);
    const glm::dmat3 back = decode_rotation(code);
    for (glm::length_t c = 0; c < 3; ++c) EXPECT_LT(glm::distance(axes[c], back[c]), 4e-9);
    EXPECT_EQ(encode_rotation(back), code);
  }
}

/// Shapes that leave the usual: no holes, single rows, nothing but holes, chequers, largest steps.
std::vector<Patch> odd_patches() {
  std::vector<Patch> patches;
  PatchShape shape;
  patches.push_back(bumpy_patch(shape));
  shape.width = 97;
  shape.height = 61;
  shape.noise = 3.0;
  patches.push_back(bumpy_patch(shape));
  shape.round = false;
  patches.push_back(bumpy_patch(shape));
  shape.width = 1;
  patches.push_back(bumpy_patch(shape));
  shape.height = 1;
  patches.push_back(bumpy_patch(shape));
  shape.width = 300;
  patches.push_back(bumpy_patch(shape));
  patches.push_back(patches.front());
  std::fill(patches.back().heights.begin(), patches.back().heights.end(), kHole);
  patches.push_back(patches.front());
  for (std::size_t k = 0; k < patches.back().heights.size(); ++k) {
    patches.back().heights[k] = k % 2 == 0 ? kHole : (k % 3 == 0 ? 0 : kMaxHeightRange);
  }
  patches.push_back(patches[2]);
  std::mt19937 random(11);
  for (std::int32_t& h : patches.back().heights) {
    h = random() % 3 == 0 ? kHole : static_cast<std::int32_t>(random() % 65535);
  }
  return patches;
}

Patch without_heights(const Patch& patch) {
  Patch empty = patch;
  empty.heights.clear();
  return empty;
}

TEST(CompactHeights, AreGivenBackExactly) {
  for (const Patch& patch : odd_patches()) {
    const std::vector<std::byte> bytes = encode_heights_compact(patch);
    Patch read = without_heights(patch);
    const Status decoded =
        decode_heights_compact(bytes, static_cast<std::uint32_t>(count_samples(patch)), 0, read);
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_EQ(read.heights, patch.heights) << patch.width << 'x' << patch.height;
    // No room for bytes that mean nothing.
    for (const std::size_t cut : {std::size_t{1}, std::size_t{2}, bytes.size()}) {
      Patch other = without_heights(patch);
      EXPECT_FALSE(decode_heights_compact(std::span(bytes).first(bytes.size() - cut),
                                          static_cast<std::uint32_t>(count_samples(patch)), 0,
                                          other));
    }
  }
}

TEST(CompactHeights, HoldOnHostileBytes) {
  std::mt19937 random(2);
  const Patch patch = bumpy_patch({});
  const auto samples = static_cast<std::uint32_t>(count_samples(patch));
  std::size_t refused = 0;
  for (int k = 0; k < 2000; ++k) {
    std::vector<std::byte> bytes(random() % 600);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    Patch read = without_heights(patch);
    if (!decode_heights_compact(bytes, samples, 0, read)) ++refused;
  }
  EXPECT_EQ(refused, 2000U);
}

/// A grid as large as can be without samples takes 12 KB; less is refused before it is decoded.
TEST(CompactHeights, AreNoBombs) {
  Patch patch;
  patch.width = kMaxPatchSide;
  patch.height = 1024;
  patch.heights.assign(std::size_t{patch.width} * patch.height, kHole);
  std::vector<std::byte> bytes = encode_heights_compact(patch);
  Patch read = without_heights(patch);
  ASSERT_TRUE(decode_heights_compact(bytes, 0, 0, read));
  EXPECT_EQ(read.heights, patch.heights);
  bytes.resize(500);
  read = without_heights(patch);
  const Status decoded = decode_heights_compact(bytes, 0, 0, read);
  ASSERT_FALSE(decoded);
  EXPECT_EQ(decoded.error().message, "they are too few for the mask");
}

PatchFileOptions compact(double normal_degrees) {
  return {PatchCodec::Compact, normal_degrees};
}

TEST(CompactFile, KeepsHeightsColoursPositionsAndNormals) {
  const ScratchFolder folder;
  for (const std::uint32_t colours : {0U, 1U, 3U}) {
    for (const double degrees : {0.1, 1.0, 5.0}) {
      const PatchModel model = bumpy_model(9, colours);
      ASSERT_TRUE(write_patch_file(folder / "a.relief", model, compact(degrees)));
      const PatchModel read = read_whole(folder / "a.relief");
      ASSERT_EQ(read.patches.size(), model.patches.size());
      EXPECT_EQ(read.bounds.min, model.bounds.min);
      EXPECT_EQ(read.spacing, model.spacing);
      for (std::size_t p = 0; p < model.patches.size(); ++p) {
        const Patch& in = model.patches[p];
        const Patch& out = read.patches[p];
        ASSERT_EQ(in.heights, out.heights);
        EXPECT_EQ(in.spacing, out.spacing);
        EXPECT_EQ(in.height_step, out.height_step);
        const auto kept = kept_texels(in, 1);
        float least = 1.0F;
        for (std::uint32_t j = 0; j < in.height; ++j) {
          for (std::uint32_t i = 0; i < in.width; ++i) {
            const std::size_t k = std::size_t{j} * in.width + i;
            if (kept[k] == 0) continue;
            // A 16th of a step each way, half of it off at most, along three axes: 0.054; what
            // turning does to a patch of this size is nothing beside.
            ASSERT_LT(glm::distance(position_of(in, i, j), position_of(out, i, j)),
                      0.06 * in.height_step);
            least = std::min(least, glm::dot(unit_from_snorm16(in.normals.texels[k]),
                                             unit_from_snorm16(out.normals.texels[k])));
          }
        }
        // Rounding of single precision: 2e-7 of the cosine, 0.04 degrees.
        EXPECT_GT(least, std::cos(glm::radians(degrees)) - 2e-7) << degrees;
        ASSERT_EQ(in.colours.texels.size(), out.colours.texels.size());
        if (colours == 0) continue;
        const auto kept_colours = kept_texels(in, colours);
        for (std::size_t k = 0; k < kept_colours.size(); ++k) {
          if (kept_colours[k] != 0) {
            ASSERT_EQ(in.colours.texels[k], out.colours.texels[k]);
          }
        }
      }
    }
  }
}

TEST(CompactFile, HoldsAllNormalsInItsCones) {
  const ScratchFolder folder;
  for (const double degrees : {0.1, 2.0}) {
    ASSERT_TRUE(write_patch_file(folder / "a.relief", bumpy_model(12), compact(degrees)));
    const auto file = PatchFile::open(folder / "a.relief");
    ASSERT_TRUE(file);
    for (std::size_t p = 0; p < 12; ++p) {
      const PatchSummary& summary = file->patches()[p];
      const auto patch = file->read_patch(p);
      ASSERT_TRUE(patch);
      EXPECT_EQ(summary.origin, patch->origin);
      EXPECT_EQ(summary.samples, count_samples(*patch));
      const glm::vec3 axis = unit_from_snorm16(summary.cone_axis);
      float widest = 1.0F;
      for (std::size_t k = 0; k < patch->heights.size(); ++k) {
        if (patch->heights[k] == kHole) continue;
        widest = std::min(widest, glm::dot(axis, unit_from_snorm16(patch->normals.texels[k])));
      }
      EXPECT_LE(summary.cone_cosine, widest);
      // An axis that is half a step of 0.6 degrees off, and a cosine rounded down to 1 / 127.
      EXPECT_GT(summary.cone_cosine, widest - 0.03F);
    }
  }
}

TEST(CompactFile, LeavesNormalsOutThatHeightsTell) {
  const ScratchFolder folder;
  PatchModel model = bumpy_model(3);
  ASSERT_TRUE(write_patch_file(folder / "kept.relief", model, compact(0.1)));
  ASSERT_TRUE(write_patch_file(folder / "left_out.relief", model, compact(90.0)));
  EXPECT_LT(std::filesystem::file_size(folder / "left_out.relief"),
            std::filesystem::file_size(folder / "kept.relief") / 2);
  const PatchModel read = read_whole(folder / "left_out.relief");
  for (const Patch& patch : read.patches) {
    // There are still normals: those derived from the heights.
    ASSERT_EQ(patch.normals.texels.size(), patch.heights.size());
  }
  for (Patch& patch : model.patches) patch.normals = {};
  ASSERT_TRUE(write_patch_file(folder / "none.relief", model, compact(0.1)));
  for (const Patch& patch : read_whole(folder / "none.relief").patches) {
    EXPECT_TRUE(patch.normals.empty());
  }
}

TEST(CompactFile, IsTheSameWhenWrittenAgain) {
  const ScratchFolder folder;
  const PatchModel model = bumpy_model(9, 2);
  ASSERT_TRUE(write_patch_file(folder / "a.relief", model, compact(0.5)));
  ASSERT_TRUE(write_patch_file(folder / "b.relief", read_whole(folder / "a.relief"), compact(0.5)));
  EXPECT_EQ(test::slurp(folder / "a.relief"), test::slurp(folder / "b.relief"));
}

TEST(CompactFile, IsSmallerThanTheFastOne) {
  const ScratchFolder folder;
  const PatchModel model = bumpy_model(20, 1);
  ASSERT_TRUE(write_patch_file(folder / "fast.relief", model));
  ASSERT_TRUE(write_patch_file(folder / "compact.relief", model, compact(0.1)));
  EXPECT_LT(static_cast<double>(std::filesystem::file_size(folder / "compact.relief")),
            0.8 * static_cast<double>(std::filesystem::file_size(folder / "fast.relief")));
}

TEST(CompactFile, KeepsOddPatchesAndAnEmptyModel) {
  const ScratchFolder folder;
  PatchModel model = bumpy_model(1);
  for (Patch& patch : odd_patches()) {
    patch.normals = {};
    patch.spacing *= 1.0 + static_cast<double>(model.patches.size() % 3);
    model.patches.push_back(std::move(patch));
  }
  ASSERT_TRUE(write_patch_file(folder / "a.relief", model, compact(0.1)));
  const PatchModel read = read_whole(folder / "a.relief");
  for (std::size_t p = 0; p < model.patches.size(); ++p) {
    EXPECT_EQ(read.patches[p].heights, model.patches[p].heights) << p;
    EXPECT_EQ(read.patches[p].spacing, model.patches[p].spacing) << p;
  }
  ASSERT_TRUE(write_patch_file(folder / "b.relief", PatchModel(), compact(0.1)));
  EXPECT_TRUE(read_whole(folder / "b.relief").patches.empty());
}

/// Every 2^level-th node, whichever the codec.
TEST(Levels, AreThoseNodesOfTheWholePatch) {
  const ScratchFolder folder;
  PatchModel model = bumpy_model(1);
  model.patches = odd_patches();
  for (Patch& patch : model.patches) patch.normals = {};
  for (const PatchCodec codec : {PatchCodec::Fast, PatchCodec::Compact}) {
    ASSERT_TRUE(write_patch_file(folder / "a.relief", model, {codec, 0.5}));
    const auto file = PatchFile::open(folder / "a.relief");
    ASSERT_TRUE(file);
    for (std::size_t p = 0; p < model.patches.size(); ++p) {
      const Patch& whole = model.patches[p];
      for (const unsigned level : {0U, 1U, 2U, 3U, 10U}) {
        const auto coarse = file->read_level(p, level);
        ASSERT_TRUE(coarse) << coarse.error().message;
        ASSERT_EQ(coarse->width, ((whole.width - 1) >> level) + 1);
        ASSERT_EQ(coarse->height, ((whole.height - 1) >> level) + 1);
        EXPECT_EQ(coarse->spacing, std::ldexp(whole.spacing, static_cast<int>(level)));
        for (std::uint32_t j = 0; j < coarse->height; ++j) {
          for (std::uint32_t i = 0; i < coarse->width; ++i) {
            ASSERT_EQ(coarse->at(i, j), whole.at(i << level, j << level));
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace relief

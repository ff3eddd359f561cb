// Patches at the limits of what a file can hold, through both codecs.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/octahedral.h"
#include "common/patch_file/patch_file.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

using test::ScratchFolder;

Patch grid(std::uint32_t width, std::uint32_t height) {
  Patch patch;
  patch.width = width;
  patch.height = height;
  patch.height_step = 0.05;
  patch.heights.assign(std::size_t{width} * height, 0);
  patch.normals = {width, height, 1, {}};
  patch.normals.texels.assign(patch.heights.size(), snorm16_from_unit(glm::vec3(0, 0, 1)));
  return patch;
}

/// Writes and reads a model of one patch, by each codec, and expects every height back.
void expect_kept(const Patch& patch, const char* what) {
  const ScratchFolder folder;
  for (const PatchCodec codec : {PatchCodec::Fast, PatchCodec::Compact}) {
    PatchModel model;
    model.patches = {patch};
    model.spacing = patch.spacing;
    for_each_position(model.patches, [&](glm::dvec3 p) { extend(model.bounds, p); });
    const Status written = write_patch_file(folder / "a.relief", model, {.codec = codec});
    ASSERT_TRUE(written) << what << ": " << written.error().message;
    Progress silent;
    const auto file = PatchFile::open(folder / "a.relief");
    ASSERT_TRUE(file) << what << ": " << file.error().message;
    const auto read = file->read_all(silent);
    ASSERT_TRUE(read) << what << ": " << read.error().message;
    ASSERT_EQ(read->patches.size(), 1U);
    EXPECT_EQ(read->patches[0].heights, patch.heights) << what;
    EXPECT_EQ(read->patches[0].spacing, patch.spacing) << what;
    // The compact file rounds origins, by a tenth of a height step at most.
    EXPECT_LE(glm::length(read->patches[0].origin - patch.origin), 0.1 * patch.height_step) << what;
  }
}

TEST(CodecLimits, KeepHeightsAtBothEndsOfTheirRange) {
  Patch patch = grid(64, 64);
  for (std::size_t k = 0; k < patch.heights.size(); ++k)
    patch.heights[k] = k % 2 == 0 ? 0 : kMaxHeightRange;
  expect_kept(patch, "alternating");
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> any(0, kMaxHeightRange);
  for (std::int32_t& h : patch.heights) h = any(random) % 3 == 0 ? kHole : any(random);
  expect_kept(patch, "at random");
}

TEST(CodecLimits, KeepOneSample) {
  Patch patch = grid(1, 1);
  expect_kept(patch, "the lowest");
  patch.heights[0] = kMaxHeightRange;
  expect_kept(patch, "the highest");
}

TEST(CodecLimits, KeepTheWidestPatches) {
  for (const std::uint32_t width : {4096U, kMaxPatchSide}) {
    Patch patch = grid(width, 8);
    for (std::size_t k = 0; k < patch.heights.size(); ++k)
      patch.heights[k] = static_cast<std::int32_t>(30000 + 20000 * std::sin(0.01 * double(k)));
    expect_kept(patch, "wide");
    std::swap(patch.width, patch.height);
    std::swap(patch.normals.width, patch.normals.height);
    expect_kept(patch, "high");
  }
}

TEST(CodecLimits, KeepOneSampleAmongHoles) {
  for (const std::size_t at :
       {std::size_t{0}, std::size_t{777'777}, std::size_t{4096} * 1024 - 1}) {
    Patch patch = grid(4096, 1024);
    patch.heights.assign(patch.heights.size(), kHole);
    patch.heights[at] = 12345;
    expect_kept(patch, "a sample among holes");
  }
}

TEST(CodecLimits, KeepPatchesOfAnySizeAnywhere) {
  for (const double scale : {1e-30, 1e-9, 1e9, 1e30}) {
    Patch patch = grid(9, 9);
    patch.spacing *= scale;
    patch.height_step *= scale;
    for (std::size_t k = 0; k < patch.heights.size(); ++k)
      patch.heights[k] = static_cast<std::int32_t>(7 * k % 100);
    expect_kept(patch, "scaled");
    // A thousandth of a height step is the last digit that doubles have here.
    patch.origin = glm::dvec3(1e11, -1e11, 1e11) * scale;
    expect_kept(patch, "far away");
  }
}

}  // namespace
}  // namespace relief

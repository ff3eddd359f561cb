// The patch file: what goes in comes out, and the bytes do not depend on how they were made.
#include "common/patch_file.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "common/patch_codec.h"
#include "tests/common/sample_models.h"

namespace relief {
namespace {

using test::bumpy_model;
using test::bumpy_patch;
using test::ScratchFolder;
using test::slurp;

PatchModel read_whole(const std::filesystem::path& path) {
  const auto file = PatchFile::open(path);
  EXPECT_TRUE(file) << file.error().message;
  Progress progress;
  auto model = file->read_all(progress);
  EXPECT_TRUE(model) << model.error().message;
  return *std::move(model);
}

/// The texels that the file keeps are what `stored` makes of those that went in.
template <class Texel, class Stored>
void expect_same_map(const Patch& patch, const AttributeMap<Texel>& in,
                     const AttributeMap<Texel>& out, const Stored& stored) {
  ASSERT_EQ(in.texels.size(), out.texels.size());
  if (in.empty()) return;
  ASSERT_EQ(in.scale, out.scale);
  ASSERT_EQ(in.width, out.width);
  const auto kept = kept_texels(patch, in.scale);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (kept[k] == 0) continue;
    ASSERT_EQ(stored(in.texels[k]), out.texels[k]) << "texel " << k;
  }
}

void expect_same(const Patch& a, const Patch& b) {
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.axes, b.axes);
  EXPECT_EQ(a.spacing, b.spacing);
  EXPECT_EQ(a.height_step, b.height_step);
  ASSERT_EQ(a.width, b.width);
  ASSERT_EQ(a.height, b.height);
  EXPECT_EQ(a.heights, b.heights);
  expect_same_map(a, a.normals, b.normals, rounded_normal);
  expect_same_map(a, a.colours, b.colours, [](glm::u8vec3 c) { return c; });
}

void expect_same(const PatchModel& a, const PatchModel& b) {
  EXPECT_EQ(a.spacing, b.spacing);
  EXPECT_EQ(a.bounds.min, b.bounds.min);
  EXPECT_EQ(a.bounds.max, b.bounds.max);
  EXPECT_EQ(a.bounding_radius, b.bounding_radius);
  EXPECT_EQ(a.has_colours, b.has_colours);
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t p = 0; p < a.patches.size(); ++p) {
    SCOPED_TRACE(p);
    expect_same(a.patches[p], b.patches[p]);
  }
}

TEST(PatchFile, GivesBackWhatWasWritten) {
  const ScratchFolder folder;
  const PatchModel model = bumpy_model(9, 2);
  ASSERT_TRUE(write_patch_file(folder / "a.relief", model));
  expect_same(model, read_whole(folder / "a.relief"));
  EXPECT_EQ(folder.count(), 1);
}

}  // namespace
}  // namespace relief

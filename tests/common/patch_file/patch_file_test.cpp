// The patch file: what goes in comes out, and the bytes do not depend on how they were made.
#include "common/patch_file/patch_file.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <glm/trigonometric.hpp>

#include "common/patch_file/fast/patch_codec.h"
#include "tests/common/patch_file/read_whole.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

using test::bumpy_model;
using test::bumpy_patch;
using test::PatchShape;
using test::read_whole;
using test::ScratchFolder;
using test::slurp;

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
  EXPECT_EQ(a.is_closed, b.is_closed);
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t p = 0; p < a.patches.size(); ++p) {
    SCOPED_TRACE(p);
    expect_same(a.patches[p], b.patches[p]);
  }
}

TEST(PatchFile, GivesBackWhatWasWritten) {
  const ScratchFolder folder;
  for (const std::uint32_t colours : {0U, 1U, 3U}) {
    const PatchModel model = bumpy_model(9, colours);
    ASSERT_TRUE(write_patch_file(folder / "a.relief", model));
    expect_same(model, read_whole(folder / "a.relief"));
  }
  EXPECT_EQ(folder.count(), 1);
}

TEST(PatchFile, KeepsThatPatchesThatMeetHaveNoBorder) {
  const ScratchFolder folder;
  PatchModel model = bumpy_model(2);
  for (const bool is_closed : {false, true}) {
    for (const bool is_borderless : {false, true}) {
      model.is_closed = is_closed;
      model.joined = {{0, 2, is_borderless || is_closed}};
      ASSERT_TRUE(write_patch_file(folder / "a.relief", model));
      const PatchModel read = read_whole(folder / "a.relief");
      EXPECT_EQ(read.is_closed, is_closed);
      EXPECT_EQ(read.joined.front().is_closed, is_borderless || is_closed);
      // Files of closed models are as they were before the flag.
      EXPECT_EQ(slurp(folder / "a.relief")[112], is_closed ? 3 : is_borderless ? 6 : 2);
    }
  }
}

TEST(PatchFile, KeepsThatPatchesThatMeetAreOfPoints) {
  const ScratchFolder folder;
  PatchModel model = bumpy_model(2);
  model.joined = {{0, 2, false}};
  for (const bool is_of_points : {false, true}) {
    model.is_of_points = is_of_points;
    ASSERT_TRUE(write_patch_file(folder / "a.relief", model));
    EXPECT_EQ(read_whole(folder / "a.relief").is_of_points, is_of_points);
    EXPECT_EQ(slurp(folder / "a.relief")[112], is_of_points ? 10 : 2);
  }
}

TEST(PatchFile, KeepsThatAModelIsClosed) {
  const ScratchFolder folder;
  PatchModel model = bumpy_model(2);
  ASSERT_TRUE(write_patch_file(folder / "open.relief", model));
  model.is_closed = true;
  ASSERT_TRUE(write_patch_file(folder / "closed.relief", model));
  expect_same(model, read_whole(folder / "closed.relief"));
  EXPECT_TRUE(PatchFile::open(folder / "closed.relief")->info().is_closed);
  EXPECT_FALSE(PatchFile::open(folder / "open.relief")->info().is_closed);
  // A bit of the header, and its checksum: files of other models are as they always were.
  const std::string open = slurp(folder / "open.relief");
  std::string closed = slurp(folder / "closed.relief");
  ASSERT_EQ(closed[112], 1);
  closed[112] = 0;
  EXPECT_EQ(closed.substr(0, 124), open.substr(0, 124));
  EXPECT_EQ(closed.substr(128), open.substr(128));
}

TEST(PatchFile, KeepsOddPatches) {
  const ScratchFolder folder;
  PatchModel model = bumpy_model(1);
  PatchShape shape;
  shape.round = false;  // no holes
  model.patches.push_back(bumpy_patch(shape));
  shape.width = 1;  // a single row, a single column, a single node
  model.patches.push_back(bumpy_patch(shape));
  shape.height = 1;
  model.patches.push_back(bumpy_patch(shape));
  shape.width = 300;
  shape.normals = 3;  // finer than the grid
  shape.colours = 2;
  model.patches.push_back(bumpy_patch(shape));
  shape.height = 20;
  shape.round = true;
  model.patches.push_back(bumpy_patch(shape));
  shape.normals = 0;  // no attributes
  shape.colours = 0;
  model.patches.push_back(bumpy_patch(shape));
  model.patches.push_back(model.patches.back());  // nothing but holes
  std::fill(model.patches.back().heights.begin(), model.patches.back().heights.end(), kHole);
  model.patches.push_back(model.patches.front());  // a chequered mask and the largest steps
  for (std::size_t k = 0; k < model.patches.back().heights.size(); ++k) {
    model.patches.back().heights[k] = k % 2 == 0 ? kHole : (k % 3 == 0 ? 0 : kMaxHeightRange);
  }
  model.patches.push_back(model.patches.front());  // normals all over the octahedron
  std::mt19937 random(7);
  for (glm::i16vec2& n : model.patches.back().normals.texels) {
    n = {static_cast<std::int16_t>(static_cast<int>(random() % 65535) - 32767),
         static_cast<std::int16_t>(static_cast<int>(random() % 65535) - 32767)};
  }
  model.has_colours = true;
  ASSERT_TRUE(write_patch_file(folder / "a.relief", model));
  expect_same(model, read_whole(folder / "a.relief"));
}

TEST(PatchFile, KeepsAModelWithoutPatches) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_patch_file(folder / "a.relief", PatchModel()));
  const PatchModel model = read_whole(folder / "a.relief");
  EXPECT_TRUE(model.patches.empty());
  EXPECT_TRUE(model.bounds.empty());
}

TEST(PatchFile, DescribesItsContentWithoutReadingPatches) {
  const ScratchFolder folder;
  const PatchModel model = bumpy_model(5, 1);
  ASSERT_TRUE(write_patch_file(folder / "a.relief", model));
  const auto file = PatchFile::open(folder / "a.relief");
  ASSERT_TRUE(file);
  const PatchFileInfo& info = file->info();
  EXPECT_EQ(info.version, 1U);
  EXPECT_EQ(info.codec, "fast");
  EXPECT_EQ(info.patches, 5U);
  EXPECT_EQ(info.samples, count_samples(model));
  EXPECT_EQ(info.spacing, model.spacing);
  EXPECT_EQ(info.file_bytes, std::filesystem::file_size(folder / "a.relief"));
  EXPECT_EQ(info.bounds.max, model.bounds.max);
  EXPECT_EQ(info.attributes, (std::vector<std::string>{"normal", "colour"}));

  ASSERT_EQ(file->patches().size(), 5U);
  for (std::size_t p = 0; p < 5; ++p) {
    const PatchSummary& summary = file->patches()[p];
    const auto patch = file->read_patch(p);
    ASSERT_TRUE(patch);
    EXPECT_EQ(summary.origin, patch->origin);
    EXPECT_EQ(summary.axes, patch->axes);
    EXPECT_EQ(summary.samples, count_samples(*patch));
    EXPECT_EQ(file->map_scales(p).normals, patch->normals.scale);
    EXPECT_EQ(file->map_scales(p).colours, patch->colours.scale);
    std::int32_t lowest = kMaxHeightRange;
    std::int32_t highest = 0;
    const glm::vec3 axis = unit_from_snorm16(summary.cone_axis);
    float widest = 1.0F;
    for (std::size_t k = 0; k < patch->heights.size(); ++k) {
      if (patch->heights[k] == kHole) continue;
      lowest = std::min(lowest, patch->heights[k]);
      highest = std::max(highest, patch->heights[k]);
      widest = std::min(widest, glm::dot(axis, unit_from_snorm16(patch->normals.texels[k])));
    }
    EXPECT_EQ(summary.min_height, lowest);
    EXPECT_EQ(summary.max_height, highest);
    EXPECT_LE(summary.cone_cosine, widest);
    // The cone is as narrow as the normals let it be, but for the rounding that it allows for.
    EXPECT_NEAR(summary.cone_cosine, widest, 2e-6F);
  }
}

/// Rounding is idempotent: a file that is read and written again does not change.
TEST(PatchFile, IsTheSameWhenWrittenAgain) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_patch_file(folder / "a.relief", bumpy_model(9, 2)));
  ASSERT_TRUE(write_patch_file(folder / "b.relief", read_whole(folder / "a.relief")));
  EXPECT_EQ(slurp(folder / "a.relief"), slurp(folder / "b.relief"));
}

TEST(PatchFile, DoesNotDependOnThreads) {
  const ScratchFolder folder;
  const PatchModel model = bumpy_model(40, 1);
  std::string first;
  for (const std::size_t threads : {1U, 2U, 4U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    ASSERT_TRUE(write_patch_file(folder / "a.relief", model));
    const std::string bytes = slurp(folder / "a.relief");
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first) << threads;
    expect_same(model, read_whole(folder / "a.relief"));
  }
}

/// Over a hole an attribute continues what is kept around it, out to the map's corners.
TEST(PatchFile, ContinuesAttributesOverHoles) {
  const ScratchFolder folder;
  PatchModel model = bumpy_model(1, 1);
  PatchShape shape;
  shape.width = 60;
  shape.height = 50;
  shape.colours = 1;
  model.patches = {bumpy_patch(shape)};
  const Patch& in = model.patches[0];
  glm::u8vec3 lowest(255);
  glm::u8vec3 highest(0);
  for (std::size_t k = 0; k < in.heights.size(); ++k) {
    if (in.heights[k] == kHole) {
      model.patches[0].colours.texels[k] = glm::u8vec3(k % 251);  // what must not come back
      continue;
    }
    lowest = glm::min(lowest, in.colours.texels[k]);
    highest = glm::max(highest, in.colours.texels[k]);
  }
  ASSERT_TRUE(write_patch_file(folder / "a.relief", model));
  const PatchModel out = read_whole(folder / "a.relief");
  const auto& colours = out.patches[0].colours.texels;
  for (const glm::u8vec3 colour : colours) {
    EXPECT_EQ(glm::clamp(colour, lowest, highest), colour);  // a mean stays between
  }
  // A hole beside a sample is the mean of the samples around it.
  std::size_t checked = 0;
  for (std::uint32_t j = 1; j + 1 < in.height; ++j) {
    for (std::uint32_t i = 1; i + 1 < in.width; ++i) {
      if (in.at(i, j) != kHole) continue;
      glm::dvec3 sum(0.0);
      int count = 0;
      for (std::uint32_t k = 0; k < 9; ++k) {
        const std::size_t near = std::size_t{j + k / 3 - 1} * in.width + i + k % 3 - 1;
        if (in.heights[near] == kHole) continue;
        sum += glm::dvec3(in.colours.texels[near]);
        ++count;
      }
      if (count == 0) continue;
      ++checked;
      const glm::dvec3 mean = glm::floor(sum / static_cast<double>(count) + 0.5);
      EXPECT_EQ(glm::dvec3(colours[std::size_t{j} * in.width + i]), mean);
    }
  }
  EXPECT_GT(checked, 50U);
}

/// The promise of kNormalStep: nothing is off by more than 0.1 degrees.
TEST(RoundedNormal, StaysWithinATenthOfADegree) {
  double largest = 0.0;
  for (int x = -32767; x <= 32767; x += 61) {
    for (int y = -32767; y <= 32767; y += 61) {
      const glm::i16vec2 n(x, y);
      const glm::i16vec2 rounded = rounded_normal(n);
      EXPECT_EQ(rounded_normal(rounded), rounded);
      const glm::dvec3 a = unit_from_snorm16(n);
      const glm::dvec3 b = unit_from_snorm16(rounded);
      largest = std::max(largest, glm::length(glm::cross(a, b)));
    }
  }
  EXPECT_LE(largest, glm::radians(0.1));
  EXPECT_GT(largest, glm::radians(0.05));  // otherwise bits are wasted
}

TEST(WritePatchFile, RefusesWhatCouldNotBeRead) {
  const ScratchFolder folder;
  const auto message = [&](const auto& spoil) {
    PatchModel model = bumpy_model(3, 1);
    spoil(model);
    const Status written = write_patch_file(folder / "a.relief", model);
    EXPECT_EQ(folder.count(), 0);
    return written ? std::string() : written.error().message.substr(folder.path().string().size());
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message([&](PatchModel& m) { m.patches[1].origin.y = nan; }),
            "/a.relief: patch 1 cannot be written: its origin is not finite");
  EXPECT_EQ(message([&](PatchModel& m) { m.patches[2].axes[0] *= 1.00001; }),
            "/a.relief: patch 2 cannot be written: its axes are not a rotation");
  EXPECT_NE(message([&](PatchModel& m) { m.patches[2].axes[0] *= -1.0; }), "");
  EXPECT_NE(message([&](PatchModel& m) { m.patches[2].axes[1].x = nan; }), "");
  EXPECT_NE(message([](PatchModel& m) { m.patches[0].spacing = 0.0; }), "");
  EXPECT_NE(message([](PatchModel& m) { m.patches[0].height_step = -1.0; }), "");
  EXPECT_NE(message([](PatchModel& m) { m.patches[0].height_step = 1e300; }), "");
  EXPECT_NE(message([](PatchModel& m) { m.patches[0].width += 1; }), "");
  EXPECT_NE(message([](PatchModel& m) { m.patches[0].width = 0; }), "");
  EXPECT_NE(message([](PatchModel& m) { m.patches[0].width = kMaxPatchSide + 1; }), "");
  EXPECT_NE(message([](PatchModel& m) { m.patches[0].heights[0] = -1; }), "");
  EXPECT_NE(message([](PatchModel& m) { m.patches[0].heights[0] = kMaxHeightRange + 1; }), "");
  EXPECT_NE(message([](PatchModel& m) { m.patches[0].normals.texels.pop_back(); }), "");
  EXPECT_NE(message([](PatchModel& m) { m.patches[0].colours.scale = 0; }), "");
  EXPECT_NE(message([](PatchModel& m) { m.patches[0].colours.scale = 70000; }), "");
  EXPECT_NE(message([&](PatchModel& m) { m.spacing = nan; }), "");
  EXPECT_NE(message([&](PatchModel& m) { m.bounds.max.x = nan; }), "");
  EXPECT_NE(message([&](PatchModel& m) { m.bounds.max.y = m.bounds.min.y - 1.0; }), "");
}

TEST(WritePatchFile, RefusesADirectoryAndAMissingOne) {
  const ScratchFolder folder;
  EXPECT_FALSE(write_patch_file(folder.path(), bumpy_model(1)));
  EXPECT_FALSE(write_patch_file(folder.path() / "none" / "a.relief", bumpy_model(1)));
  EXPECT_EQ(folder.count(), 0);
}

TEST(ReadAll, CanBeCancelled) {
  class Cancelled : public Progress {
   public:
    [[nodiscard]] bool cancelled() const override { return true; }
  };
  const ScratchFolder folder;
  ASSERT_TRUE(write_patch_file(folder / "a.relief", bumpy_model(2)));
  const auto file = PatchFile::open(folder / "a.relief");
  ASSERT_TRUE(file);
  Cancelled progress;
  const auto model = file->read_all(progress);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().message, "interrupted");
}

}  // namespace
}  // namespace relief

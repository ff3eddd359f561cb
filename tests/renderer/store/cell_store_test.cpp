// What is uploaded for each primitive, and nothing else.
#include "renderer/store/cell_store.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "renderer/engines/onepass/features.h"
#include "renderer/store/collected_store.h"
#include "renderer/store/patch_store.h"
#include "tests/renderer/gl/own_context.h"
#include "tests/renderer/scenes.h"

namespace relief {
namespace {

class Stores : public testing::Test {
 protected:
  /// What an image with these settings needs of the model.
  PatchStore upload(Primitive primitive, Interpolation interpolation) {
    RenderSettings settings;
    settings.primitive = primitive;
    settings.interpolation = interpolation;
    const Features features = onepass::features_of(settings, model_.has_colours);
    const auto collected =
        CollectedStore::collect(store_limits(gl()), model_, {needs_of(features), {}});
    EXPECT_TRUE(collected);
    auto store = (*collected)->upload(gl());
    EXPECT_TRUE(store);
    return std::move(*store);
  }

  [[nodiscard]] const Gl& gl() const { return context_.gl(); }

  PatchModel model_ = test::sphere_model({});
  test::OwnContext context_;
};

TEST_F(Stores, CellsHaveNoRecordsAndNoHeightMaps) {
  std::size_t parts = 0;
  for (const Patch& patch : model_.patches)
    parts += make_cells(patch, make_samples(patch)).parts.size();
  for (const Interpolation interpolation : {Interpolation::Direct, Interpolation::Corrected}) {
    const PatchStore store = upload(Primitive::Cell, interpolation);
    EXPECT_TRUE(store.pages.empty());
    EXPECT_FALSE(store.heights);
    ASSERT_TRUE(store.cells);
    EXPECT_EQ(store.cells->parts.size(), parts);
    EXPECT_EQ(store.cells->pages.size(), 1U);
  }
}

TEST_F(Stores, SplatsHaveNoCellsAndHeightMapsOnlyForCorrections) {
  for (const Primitive primitive : {Primitive::Quad, Primitive::Sprite}) {
    const PatchStore direct = upload(primitive, Interpolation::Direct);
    EXPECT_FALSE(direct.cells);
    EXPECT_FALSE(direct.heights);
    EXPECT_EQ(direct.pages.size(), 1U);
    const PatchStore corrected = upload(primitive, Interpolation::Corrected);
    EXPECT_FALSE(corrected.cells);
    EXPECT_TRUE(corrected.heights);
  }
}

TEST_F(Stores, RowsOfEachPatchFollowARowWithoutNodes) {
  CellPages collected(most_cell_texels(gl()));
  const PatchModel model = test::height_field(5, [](double, double) { return 0.0; });
  std::vector<std::int32_t> first;
  std::vector<UploadedCells::Part> parts;
  for (int patch = 0; patch < 3; ++patch) {
    const auto added = collected.add(make_cells(model.patches[0], make_samples(model.patches[0])));
    ASSERT_TRUE(added);
    first.push_back(added->first_row);
    parts.insert(parts.end(), added->parts.begin(), added->parts.end());
  }
  EXPECT_EQ(first, (std::vector<std::int32_t>{1, 7, 13}));
  const std::vector<CellPageData> pages = collected.take();
  ASSERT_EQ(pages.size(), 1U);
  EXPECT_TRUE(pages[0].strips.empty());
  const std::vector<CellRow>& rows = pages[0].rows;
  ASSERT_EQ(rows.size(), 19U);
  for (const std::size_t r : {0U, 6U, 12U, 18U}) EXPECT_EQ(rows[r].span, 0U) << r;
  // The third patch's second row: heights 55 to 59.
  EXPECT_EQ(rows[14].base, 55U);
  EXPECT_EQ(rows[14].span, 5U << 16U);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts[2].buffers.first_run, 8U);
  // The cells about the patch: two rows of six and two columns of four.
  EXPECT_EQ(parts[2].buffers.first_border, 40U);
  EXPECT_EQ(parts[2].buffers.first_rim, 0U);
}

}  // namespace
}  // namespace relief

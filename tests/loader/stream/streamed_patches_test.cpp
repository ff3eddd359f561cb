// A file with tiles, streamed into a context without a window.
#include "loader/stream/streamed_patches.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/image/srgb.h"
#include "common/scalars/colour_map.h"
#include "common/transform.h"
#include "loader/models/colour_by.h"
#include "renderer/viewport.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/loader/stream/sphere_tree.h"
#include "tests/renderer/gl/draw_viewport.h"
#include "tests/renderer/gl/own_context.h"
#include "tests/renderer/scenes.h"

namespace relief {
namespace {

constexpr std::uint64_t kMegabyte = std::uint64_t{1} << 20U;

class Streams : public testing::Test {
 protected:
  void SetUp() override {
    test::write_sphere_tree(file());
    plan_.models.push_back({file(), {}, {}, {}});
    plan_.views.emplace_back();
  }

  [[nodiscard]] std::filesystem::path file() const { return folder_ / "tree.relief"; }

  [[nodiscard]] GlLoader loader() const { return context_.loader(); }
  [[nodiscard]] const Gl& gl() const { return context_.gl(); }

  /// From `radii` away; at 3 the fine samples are about a pixel apart.
  RenderSettings view_from(double radii, double azimuth = 20.0) {
    const PatchModel& extent = source_->scene().patches;
    RenderSettings settings;
    settings.width = settings.height = 160;
    settings.background = std::nullopt;
    settings.camera = orbit_camera(0.5 * (extent.bounds.min + extent.bounds.max),
                                   extent.bounding_radius, {azimuth, 15.0, radii}, 45.0, 1.0);
    return settings;
  }

  std::unique_ptr<StreamedPatches> open(double radii = 3.0, const StreamBudget& budget = {
                                                                64 * kMegabyte, 64 * kMegabyte}) {
    auto source = TileSource::open(plan_, colour_by_);
    EXPECT_TRUE(source) << source.error().message;
    source_ = *source;
    const RenderSettings view = view_from(radii);
    auto stream = StreamedPatches::create(
        gl(), source_, pool_needs(source_->scene().patches, {&view, 1}), budget, {&view, 1}, [] {});
    EXPECT_TRUE(stream) << stream.error().message;
    return *std::move(stream);
  }

  /// With the coarsest tile alone.
  std::unique_ptr<StreamedPatches> open_from_afar() {
    auto stream = open(40.0);
    settle(*stream, view_from(40.0));
    EXPECT_EQ(stream->state().counts.read, 1U);
    return stream;
  }

  /// Updates until nothing is missing, or for ten seconds.
  static void settle(StreamedPatches& stream, const RenderSettings& view) {
    for (int k = 0; k < 1000; ++k) {
      stream.update({&view, 1}, 5.0);
      ASSERT_FALSE(stream.pool().store().instances.empty()) << "something is always drawn";
      if (stream.is_settled() && !stream.has_news()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL() << "it does not settle";
  }

  Image draw(Viewport& viewport, const RenderSettings& view) {
    return test::draw(gl(), viewport, view);
  }

  /// As `relief render` draws it: of tiles that are read for this view alone.
  Image draw_alone(const RenderSettings& view) {
    const auto tree = PatchTree::open(file());
    const std::vector<Transform> transforms(1);
    Progress silent;
    auto read = read_in_view(*tree, onlookers_of({&view, 1}, transforms, tree->extent()), silent);
    EXPECT_TRUE(read) << read.error().message;
    if (colour_by_) {
      EXPECT_TRUE(paint_patches(*colour_by_, {}, read->model));
    }
    const auto viewport = Viewport::create(loader(), RenderModel::of(read->model), {&view, 1});
    EXPECT_TRUE(viewport) << viewport.error().message;
    return draw(**viewport, view);
  }

  Image draw(const StreamedPatches& stream, const RenderSettings& view) {
    const auto viewport =
        Viewport::create(loader(), source_->scene().patches, stream.pool(), {&view, 1});
    EXPECT_TRUE(viewport) << viewport.error().message;
    return draw(**viewport, view);
  }

  static std::size_t count_different(const Image& a, const Image& b) {
    std::size_t count = 0;
    for (const char* const channel : {"R", "G", "B", "A"}) {
      const std::vector<float>& of_a = a.find(channel)->values;
      const std::vector<float>& of_b = b.find(channel)->values;
      for (std::size_t p = 0; p < of_a.size(); ++p)
        count += std::abs(srgb8_from_linear(of_a[p]) - srgb8_from_linear(of_b[p])) > 1 ? 1 : 0;
    }
    return count;
  }

  test::ScratchFolder folder_;
  ScenePlan plan_;
  std::optional<ColourBy> colour_by_;
  test::OwnContext context_;
  std::shared_ptr<TileSource> source_;
};

TEST_F(Streams, BeginWithTheCoarsestTileAndEndWithWhatAnImageOfTheViewHas) {
  const auto stream = open();
  EXPECT_EQ(stream->state().shown_tiles, 1U);
  EXPECT_FALSE(stream->is_settled());
  for (const double radii : {3.0, 1.6, 40.0}) {
    RenderSettings view = view_from(radii);
    // `relief render` shows models that are only a few pixels wide by a mesh that stands for them,
    // unless levels of detail are finer than a pixel.
    if (radii > 10.0) view.pixels_per_sample = 0.5;
    settle(*stream, view);
    const std::size_t tiles = stream->state().shown_tiles;
    EXPECT_EQ(tiles == 1, radii > 10.0) << radii;
    // Where patches overlap at the same depth, the one that is drawn first is seen.
    EXPECT_LE(count_different(draw(*stream, view), draw_alone(view)), 4 * 160 * 160 / 1000U)
        << radii;
  }
}

TEST_F(Streams, AreColouredByAScalarOfTheFile) {
  test::write_sphere_tree(file(), true);
  colour_by_ = ColourBy{.scalar = "classification"};
  const auto stream = open();
  const LoadedScene& scene = source_->scene();
  ASSERT_TRUE(scene.colours);
  EXPECT_EQ(scene.colours->labels, (std::vector<std::uint32_t>{2, 6}));
  EXPECT_TRUE(scene.patches.has_label_colours);
  EXPECT_TRUE(scene.patches.scalars.empty());
  RenderSettings view = view_from(3.0);
  view.material = Material::Unlit;
  settle(*stream, view);
  const Image streamed = draw(*stream, view);
  EXPECT_LE(count_different(streamed, draw_alone(view)), 4 * 160 * 160 / 1000U);
  // Labels are never mixed.
  std::set<std::uint8_t> greens;
  for (std::size_t p = 0; p < streamed.find("G")->values.size(); ++p) {
    if (streamed.find("A")->values[p] == 1.0F)
      greens.insert(srgb8_from_linear(streamed.find("G")->values[p]));
  }
  EXPECT_EQ(greens, (std::set<std::uint8_t>{las_class_colour(2).g, las_class_colour(6).g}));
}

TEST_F(Streams, AreColouredByHeight) {
  colour_by_ = ColourBy{.scalar = kHeightScalar, .up = glm::dvec3(0.0, 0.0, 1.0)};
  const auto stream = open();
  const auto scale = source_->scene().colours;
  ASSERT_TRUE(scale);
  // 2 and 98 % of a sphere's area are below these heights.
  EXPECT_NEAR(scale->low, -0.96, 0.06);
  EXPECT_NEAR(scale->high, 0.96, 0.06);
  const TileIndex index = *source_->read_index(1);
  const auto read = source_->read_patches({1, 0}, index.chunks.front());
  ASSERT_TRUE(read) << read.error().message;
  const Patch& patch = read->model.patches.front();
  const std::uint32_t i = patch.width / 2;
  const std::uint32_t j = patch.height / 2;
  EXPECT_EQ(texel_at(patch.colours, i, j), scale->at(position_of(patch, i, j).z));
}

TEST_F(Streams, AreNotColouredByAScalarThatTheFileLacks) {
  const auto source = TileSource::open(plan_, ColourBy{.scalar = "classification"});
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_EQ(*source, nullptr);
}

TEST_F(Streams, ReadNothingTwiceWhileThereIsRoom) {
  const auto stream = open();
  settle(*stream, view_from(3.0));
  settle(*stream, view_from(3.0, 200.0));
  const LoaderCounts before = stream->state().counts;
  settle(*stream, view_from(3.0));
  EXPECT_EQ(stream->state().counts.read, before.read);
  EXPECT_EQ(stream->state().counts.indices, before.indices);
}

TEST_F(Streams, ShowWhatFitsTheBudget) {
  const auto stream = open(3.0, {64 * kMegabyte, kMegabyte});
  settle(*stream, view_from(3.0));
  EXPECT_TRUE(stream->state().is_coarser);
  EXPECT_EQ(stream->state().shown_tiles, 1U);
  EXPECT_TRUE(stream->take_failures().empty());
}

TEST_F(Streams, SayOnceThatTheFileHasVanishedAndKeepThePicture) {
  const auto stream = open_from_afar();
  std::filesystem::remove(file());
  settle(*stream, view_from(3.0));
  const std::vector<std::string> failures = stream->take_failures();
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_EQ(failures.front(),
            file().string() + ": has vanished while it was shown; what has been read of it stays");
  EXPECT_EQ(stream->state().shown_tiles, 2U) << "the coarsest, and one that was open";
  EXPECT_GT(draw(*stream, view_from(3.0)).find("A")->values[80 * 160 + 80], 0.0F);
}

TEST_F(Streams, NoticeThatTheFileHasChanged) {
  const auto stream = open_from_afar();
  std::filesystem::last_write_time(
      file(), std::filesystem::last_write_time(file()) + std::chrono::hours(1));
  settle(*stream, view_from(3.0));
  const std::vector<std::string> failures = stream->take_failures();
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_NE(failures.front().find("has changed"), std::string::npos) << failures.front();
}

TEST_F(Streams, LetCoarserPatchesStandInForADamagedTile) {
  const auto tree = PatchTree::open(file());
  ASSERT_TRUE(tree);
  const TreeTile& damaged = tree->tiles()[2];
  std::string bytes = test::slurp(file());
  for (std::uint64_t k = damaged.offset + 200; k < damaged.offset + 300; ++k) bytes[k] ^= 0x55;
  test::spill(file(), bytes);
  const auto stream = open();
  settle(*stream, view_from(3.0));
  const std::vector<std::string> failures = stream->take_failures();
  ASSERT_GE(failures.size(), 1U);
  EXPECT_NE(failures.front().find("the file is damaged"), std::string::npos) << failures.front();
  const Image image = draw(*stream, view_from(3.0));
  // The sphere is 123 pixels wide: there is no hole in it.
  for (std::uint32_t y = 0; y < 160; ++y) {
    for (std::uint32_t x = 0; x < 160; ++x) {
      if (std::hypot(x - 79.5, y - 79.5) > 50.0) continue;
      EXPECT_GT(image.find("A")->values[std::size_t{y} * 160 + x], 0.0F) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace relief

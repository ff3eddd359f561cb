// What a window shows, without the window: in an OpenGL context of the test's own.
#include "viewer/drawing/display.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <thread>
#include <vector>

#include "loader/scene/first_look.h"
#include "loader/stream/tile_source.h"
#include "renderer/render.h"
#include "tests/loader/stream/sphere_tree.h"
#include "tests/renderer/scenes.h"
#include "tests/viewer/drawing/own_display.h"
#include "viewer/document/scan_points.h"
#include "viewer/drawing/probed_surface.h"

namespace relief {
namespace {

PatchModel ball() {
  test::SphereShape shape;
  shape.bumps = 0.1;
  shape.patches_per_side = 2;
  return test::sphere_model(shape);
}

/// How many values differ by more than the roundings of a half float. Bands have projections of
/// their own, and windows all levels: an edge's pixel may differ in one sample of four.
int others(const std::vector<float>& a, const std::vector<float>& b) {
  int count = 0;
  for (std::size_t k = 0; k < a.size(); ++k) count += std::abs(a[k] - b[k]) > 0x1p-9F ? 1 : 0;
  return count;
}

using Showing = test::OwnDisplay;

TEST_F(Showing, IsCoarseInMotionAndAtRestWhatRenderDraws) {
  show(ball());
  ASSERT_TRUE(display_->update(session_, true));
  EXPECT_LT(display_->picture()->width, 96U);
  EXPECT_FALSE(display_->is_complete());
  finish();
  const Image shown = picture();
  ASSERT_EQ(shown.width, 96U);
  const auto settings = settings_of(session_, session_.look);
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->samples, kPictureSamples);
  display_.reset();
  context_.reset();
  Progress silent;
  const auto rendered = render(session_.scene->patches, *settings, silent);
  ASSERT_TRUE(rendered) << rendered.error().message;
  for (const char* const name : {"R", "G", "B"})
    EXPECT_LE(others(shown.find(name)->values, rendered->image.find(name)->values), 2);
}

TEST_F(Showing, MovingPicturesReadTilesAsFineAsTheyShowThem) {
  const std::filesystem::path file = folder_ / "tree.relief";
  test::write_sphere_tree(file);
  ScenePlan plan;
  plan.models.push_back({file, {}, {}, {}});
  auto source = TileSource::open(plan);
  ASSERT_TRUE(source) << source.error().message;
  auto scene = std::make_shared<LoadedScene>((*source)->scene());
  scene->tiles = *source;
  session_.window = {48, 32};
  session_.navigator.set_image({48, 32});
  show(scene);
  // Where it is nearest, the sphere's coarse samples are 2 pixels of the window apart: at rest
  // there are samples each half a pixel, in the coarsest moving pictures each 3.3.
  const auto settle = [&](bool moves) {
    for (int k = 0; k < 1000; ++k) {
      EXPECT_TRUE(display_->stream(session_, moves));
      if (session_.stream->waiting == 0 && !display_->has_tiles_to_take()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL() << "it does not settle";
  };
  while (display_->pacer().quality().scale > kQualities.back().scale) display_->pacer().note(1e3);
  for (const bool moves : {true, false, true}) {
    settle(moves);
    EXPECT_EQ(session_.stream->shown_tiles, moves ? 1U : 4U);
  }
}

TEST_F(Showing, TwoLooksMeetAtTheDivider) {
  show(ball());
  finish();
  const Image lit = picture();
  session_.compared = session_.look;
  session_.compared->material = Material::Unlit;
  session_.look_changed = true;
  finish();
  const Image both = picture();
  const auto differs = [&](std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t y = 0; y < both.height; ++y) {
      for (std::uint32_t x = first; x < end; ++x) {
        const std::size_t p = std::size_t{y} * both.width + x;
        if (std::abs(lit.find("G")->values[p] - both.find("G")->values[p]) > 0.02F) return true;
      }
    }
    return false;
  };
  EXPECT_FALSE(differs(0, 48));
  EXPECT_TRUE(differs(48, 96));
}

/// A model with instances is collected for in the background, however small.
PatchModel placed_ball() {
  PatchModel model = ball();
  model.instances = {{0, static_cast<std::uint32_t>(model.patches.size()), {}, 0, true}};
  return model;
}

TEST_F(Showing, ALookIsCollectedForWhileTheLookBeforeIsShown) {
  show(placed_ball());
  finish();
  const std::vector<float> before = green();
  session_.look.engine = "multipass";
  session_.look_changed = true;
  ASSERT_TRUE(display_->update(session_, false));
  EXPECT_TRUE(display_->is_collecting());
  EXPECT_EQ(session_.look.engine, "multipass") << "the panels show what is chosen";
  EXPECT_TRUE(display_->is_complete()) << "nothing is drawn anew";
  finish();
  EXPECT_LE(others(green(), before), 2);
  while (!display_->has_collected()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  session_.look_changed = true;
  finish();
  EXPECT_FALSE(display_->is_collecting());
  const std::vector<float> after = green();
  EXPECT_GT(others(after, before), 20);
  show(session_.scene);
  finish();
  EXPECT_LE(others(green(), after), 2) << "as if it had been shown so from the start";
}

TEST_F(Showing, ALookThatIsTakenBackIsNotCollectedForAnyLonger) {
  show(placed_ball());
  finish();
  const std::vector<float> before = green();
  const SceneSettings look = session_.look;
  session_.look.engine = "multipass";
  session_.look_changed = true;
  ASSERT_TRUE(display_->update(session_, false));
  ASSERT_TRUE(display_->is_collecting());
  session_.look = look;
  session_.look_changed = true;
  finish();
  EXPECT_FALSE(display_->is_collecting());
  EXPECT_LE(others(green(), before), 2);
}

TEST_F(Showing, NothingIsCollectedForOnceThePointsOfAnotherFileAreShown) {
  show(placed_ball());
  finish();
  session_.look.engine = "multipass";
  session_.look_changed = true;
  ASSERT_TRUE(display_->update(session_, false));
  ASSERT_TRUE(display_->is_collecting());
  Points points;
  points.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  ASSERT_TRUE(display_->show(scan_points_of(points)));
  EXPECT_FALSE(display_->is_collecting()) << "the window would never rest";
}

TEST_F(Showing, ALookThatCannotBeDrawnIsPutBack) {
  show(ball());
  finish();
  session_.look.engine = "ewa";  // on the CPU
  session_.look_changed = true;
  EXPECT_FALSE(display_->update(session_, false));
  EXPECT_FALSE(session_.look.engine);
  finish();
}

TEST_F(Showing, ALookThatNeedsNoOtherUploadIsStillChecked) {
  session_.look.engine = "multipass";
  show(ball());
  finish();
  session_.look.opacity = 0.5F;  // which multipass does not draw
  session_.look_changed = true;
  EXPECT_FALSE(display_->update(session_, false));
  EXPECT_FALSE(session_.look.opacity);
  finish();
}

TEST_F(Showing, TheEnvironmentStandsAsTheUpAxisSays) {
  show(ball());
  const auto stance = [&] { return settings_of(session_, session_.look)->environment_stance; };
  EXPECT_EQ(stance(), Stance{});
  session_.navigator.set_up_axis(glm::dvec3(0.0, 0.0, 1.0));
  EXPECT_EQ(stance(), kZUp);
}

TEST_F(Showing, FindsTheSurfaceUnderTheCursor) {
  show(ball());
  const auto pixel = display_->probe(session_, {48.0, 32.0});
  ASSERT_TRUE(pixel);
  const auto point = surface_of(*pixel, session_, {48.0, 32.0});
  ASSERT_TRUE(point);
  EXPECT_NEAR(glm::length(point->position()), 1.0, 0.11) << "on the ball and its bumps";
  EXPECT_GT(glm::dot(point->position(), session_.navigator.camera().eye), 0.0)
      << "on the side one sees";
  const auto beside = display_->probe(session_, {1.0, 1.0});
  ASSERT_TRUE(beside);
  EXPECT_FALSE(surface_of(*beside, session_, {1.0, 1.0}));
}

TEST_F(Showing, PointsAreShownUntilThereIsASurface) {
  Points points;
  for (int k = 0; k < 4000; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / 4000.0;
    const double r = std::sqrt(1.0 - z * z);
    points.positions.emplace_back(5e6 + r * std::cos(2.4 * k), r * std::sin(2.4 * k), z);
    points.colours.emplace_back(255, 0, 0);
  }
  const ScanPoints shown = scan_points_of(points);
  session_.navigator.set_model(shown.extent, false);
  ASSERT_TRUE(display_->show(shown));
  finish();
  const Image image = picture();
  const std::size_t middle = 32 * 96 + 48;
  EXPECT_GT(image.find("R")->values[middle], 0.9F);
  EXPECT_LT(image.find("G")->values[middle], 0.1F);
  show(ball());
  finish();
  EXPECT_LT(picture().find("R")->values[middle], 0.9F);
}

}  // namespace
}  // namespace relief

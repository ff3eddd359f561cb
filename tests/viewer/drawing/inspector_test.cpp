// What inspections show at known pixels, without the window.
#include "viewer/drawing/inspector.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "common/image/srgb.h"
#include "tests/renderer/scenes.h"
#include "tests/viewer/drawing/own_display.h"
#include "viewer/drawing/difference_view.h"
#include "viewer/inspecting/inspection_colours.h"

namespace relief {
namespace {

/// A ball in a window that has no panels.
class Inspecting : public test::OwnDisplay {
 protected:
  static constexpr std::size_t kMiddle = std::size_t{kHeight / 2} * kWidth + kWidth / 2;

  Inspecting() {
    // Not from afar, as a ball of so few pixels is.
    session_.look.options["pixels-per-sample"] = 0.5;
    show(test::sphere_model({}));  // a patch a side of a cube
    // The middle of a patch, whose normal is toward the eye.
    session_.navigator.look_from(kViews.front().value);
    for (int k = 0; k < 100; ++k) session_.navigator.advance(0.05);
  }

  using OwnDisplay::show;
  void show(Inspection inspection) {
    session_.inspection = inspection;
    session_.look_changed = true;
    finish();
    ASSERT_EQ(session_.inspection, inspection);
  }
  [[nodiscard]] glm::vec3 colour_at_middle() const { return colour_at(kMiddle); }
  [[nodiscard]] glm::vec3 colour_at(std::size_t pixel) const {
    const Image image = picture();
    return {image.find("R")->values[pixel], image.find("G")->values[pixel],
            image.find("B")->values[pixel]};
  }
  [[nodiscard]] std::uint32_t patch_in_middle() {
    const auto pixel = display_->probe(session_, {kWidth / 2, kHeight / 2});
    return static_cast<std::uint32_t>(pixel->find("patch")->values.front()) - 1;
  }
};

/// Half floats, and the mean of four samples that are up to a pixel off the ball's middle, which is
/// a fiftieth of its height.
constexpr float kTolerance = 0.04F;

void expect_near(glm::vec3 shown, glm::vec3 expected) {
  EXPECT_NEAR(shown.r, expected.r, kTolerance);
  EXPECT_NEAR(shown.g, expected.g, kTolerance);
  EXPECT_NEAR(shown.b, expected.b, kTolerance);
}

TEST_F(Inspecting, PatchesHaveTheirColours) {
  show(Inspection::Patches);
  expect_near(colour_at_middle(), linear_from_srgb8(patch_colour(patch_in_middle())));
}

TEST_F(Inspecting, LevelsHaveTheirs) {
  show(Inspection::Levels);
  expect_near(colour_at_middle(), linear_from_srgb8(level_colour(0)));
  // Four times as large, so that it is not seen from afar: its samples are 4.8 pixels apart. Level
  // 1 is off by s^2 / 8 of a ball's radius, for s = 0.1, which is 1/8 of a pixel, and level 2 by
  // four times that; 32/128 of a pixel are allowed.
  Camera camera = session_.navigator.camera();
  camera.vertical_fov_degrees = 12.0;
  session_.navigator.set_camera(camera);
  session_.look.options["pixels-per-sample"] = 32.0;
  show(Inspection::Levels);
  expect_near(colour_at_middle(), linear_from_srgb8(level_colour(1)));
}

TEST_F(Inspecting, NormalsPointTowardTheEye) {
  show(Inspection::Normals);
  const auto toward = glm::vec3(glm::normalize(session_.navigator.camera().eye));
  const glm::vec3 encoded = 0.5F + 0.5F * toward;
  expect_near(colour_at_middle(), {linear_from_srgb(encoded.r), linear_from_srgb(encoded.g),
                                   linear_from_srgb(encoded.b)});
}

TEST_F(Inspecting, BesideTheModelIsTheBackground) {
  show(Inspection::Picture);
  const glm::vec3 background = colour_at(0);
  for (const Inspection inspection :
       {Inspection::Patches, Inspection::Cells, Inspection::Overdraw}) {
    show(inspection);
    EXPECT_EQ(colour_at(0), background);
  }
}

TEST_F(Inspecting, CellsAndSamplesLieOnTheSurface) {
  show(Inspection::Cells);
  // Near enough for cells of 20 pixels: some pixels are lines, most are not.
  session_.navigator.zoom(6.0, {kWidth / 2.0, kHeight / 2.0}, std::nullopt);
  for (int k = 0; k < 100; ++k) session_.navigator.advance(0.05);
  for (const Inspection inspection : {Inspection::Cells, Inspection::Samples}) {
    show(inspection);
    std::size_t marked = 0;
    for (std::size_t p = 0; p < kWidth * kHeight; p += 7) {
      const glm::vec3 colour = colour_at(p);
      marked += std::abs(colour.r - colour.g) > 0.01F ? 1 : 0;  // the surface is grey
    }
    EXPECT_GT(marked, 20U);
    EXPECT_LT(marked, kWidth * kHeight / 7 * 2 / 3);
  }
}

TEST_F(Inspecting, OverdrawCountsWhatIsShaded) {
  show(Inspection::Overdraw);
  ASSERT_TRUE(session_.inspected.fragments_a_pixel);
  // Found once at least, and shaded once.
  EXPECT_GE(*session_.inspected.fragments_a_pixel, 2.0);
  EXPECT_LT(*session_.inspected.fragments_a_pixel, 8.0);
  const glm::vec3 two = linear_from_srgb8(relief::colour_at(kFragmentMap, 2.0 / kMostFragments));
  EXPECT_GE(colour_at_middle().r, two.r - kTolerance);
  show(Inspection::Picture);
  EXPECT_FALSE(session_.inspected.fragments_a_pixel);
}

TEST_F(Inspecting, WhatCannotBeCountedIsThePictureAgain) {
  show(Inspection::Picture);
  session_.look.opacity = 0.5;
  session_.inspection = Inspection::Overdraw;
  session_.look_changed = true;
  const Status status = display_->update(session_, true);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message, "fragments of semi-transparent surfaces are not counted");
  show(Inspection::Picture);
}

TEST_F(Inspecting, ThePictureComesBack) {
  show(Inspection::Picture);
  const glm::vec3 before = colour_at_middle();
  show(Inspection::Patches);
  show(Inspection::Picture);
  EXPECT_EQ(colour_at_middle(), before);
}

TEST_F(Inspecting, TheDifferenceToRayTracingIsSmall) {
  show(Inspection::Difference);
  DifferenceView view(context_->gl(), [] {});
  bool is_shown = false;
  for (int k = 0; k < 2000 && !is_shown; ++k) {
    const auto updated =
        view.update(session_, false, display_->is_complete(), display_->picture(), 0.01 * k);
    ASSERT_TRUE(updated) << updated.error().message;
    is_shown = *updated;
    if (!is_shown) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_TRUE(is_shown);
  ASSERT_TRUE(session_.inspected.psnr_db);
  // 4 samples a pixel against 16 differ at the silhouette; another light or view has below 20.
  EXPECT_GT(*session_.inspected.psnr_db, 28.0);
  // It moves: the picture is shown again, and later traced again.
  ASSERT_TRUE(view.update(session_, true, false, display_->picture(), 100.0));
  EXPECT_FALSE(session_.inspected.psnr_db);
  EXPECT_TRUE(view.is_busy());
  session_.inspection = Inspection::Picture;
  ASSERT_TRUE(view.update(session_, true, true, display_->picture(), 101.0));
  EXPECT_FALSE(view.is_busy());
}

}  // namespace
}  // namespace relief

// Pickers that are made on another thread.
#include "viewer/measuring/background_picker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>

#include "tests/renderer/images.h"

namespace relief {
namespace {

std::shared_ptr<const PatchModel> plane(double height) {
  const test::Surface surface = [](glm::dvec3 /*base*/) {
    return test::SurfacePoint{0.0, {0.0, 0.0, 1.0}, glm::u8vec3(1, 2, 3)};
  };
  PatchModel model;
  model.patches.push_back(
      test::sample_patch({{0.0, 0.0, height}, glm::dmat3(1.0), 1.0, 11, 11}, surface, true));
  return std::make_shared<const PatchModel>(std::move(model));
}

std::shared_ptr<const SurfacePicker> wait_for(const BackgroundPicker& pickers) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (std::chrono::steady_clock::now() < until) {
    if (auto ready = pickers.ready()) return ready;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return nullptr;
}

/// The height of the surface below (5.25, 5.5, 100).
double picked_height(const SurfacePicker& picker, double about) {
  PickQuery query;
  query.start = {5.25, 5.5, 100.0};
  query.direction = {0.0, 0.0, -1.0};
  query.depth = 100.0 - about;
  query.pixel = 0.1;
  const auto point = picker.pick(query);
  return point ? point->position.z : -1.0;
}

TEST(BackgroundPicker, IsThatOfTheModelThatWasSetLast) {
  std::atomic<int> woken = 0;
  BackgroundPicker pickers([&woken] { ++woken; });
  EXPECT_EQ(pickers.ready(), nullptr);
  for (int k = 1; k < 20; ++k) pickers.set_model(plane(k));
  pickers.set_model(plane(20.0));
  const auto ready = wait_for(pickers);
  ASSERT_NE(ready, nullptr);
  // Whole coordinates: a plane's cells meet the ray exactly.
  EXPECT_EQ(picked_height(*ready, 20.0), 20.0);
  pickers.set_model(nullptr);
  EXPECT_EQ(pickers.ready(), nullptr);
  // What was handed out keeps its model.
  EXPECT_EQ(picked_height(*ready, 20.0), 20.0);
}

TEST(BackgroundPicker, ASetModelThatIsTheSameStaysReady) {
  BackgroundPicker pickers([] {});
  const auto model = plane(3.0);
  pickers.set_model(model);
  const auto ready = wait_for(pickers);
  ASSERT_NE(ready, nullptr);
  pickers.set_model(model);
  EXPECT_EQ(pickers.ready(), ready);
}

TEST(BackgroundPicker, IsDroppedWithAnotherModelOnly) {
  BackgroundPicker pickers([] {});
  const auto model = plane(3.0);
  pickers.set_model(model);
  const auto ready = wait_for(pickers);
  ASSERT_NE(ready, nullptr);
  pickers.keep_only(model.get());
  EXPECT_EQ(pickers.ready(), ready);
  pickers.keep_only(plane(4.0).get());
  EXPECT_EQ(pickers.ready(), nullptr);
}

TEST(BackgroundPicker, GoesWhileOneIsBeingMade) {
  for (int k = 0; k < 20; ++k) {
    BackgroundPicker pickers([] {});
    pickers.set_model(plane(k));
  }
}

}  // namespace
}  // namespace relief

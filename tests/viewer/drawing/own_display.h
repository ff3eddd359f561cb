// A display without a window: in an OpenGL context of the test's own.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/transform.h"
#include "renderer/frame/targets/targets.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/renderer/gl/own_context.h"
#include "viewer/drawing/display.h"

namespace relief::test {

/// A session in which a file is open, which is never read, and the display of a window of 96 times
/// 64 pixels without panels.
class OwnDisplay : public testing::Test {
 protected:
  static constexpr std::uint32_t kWidth = 96;
  static constexpr std::uint32_t kHeight = 64;

  OwnDisplay() : context_(std::in_place), session_(Document({}, [] {})) {
    auto display = Display::create(context_->loader());
    EXPECT_TRUE(display) << display.error().message;
    display_ = *std::move(display);
    spill(folder_ / "ball.ply", "");
    EXPECT_TRUE(session_.document.open({folder_ / "ball.ply"}, {}));
    session_.window = {kWidth, kHeight};
    session_.navigator.set_image({kWidth, kHeight});
  }
  ~OwnDisplay() override { display_.reset(); }

  void show(PatchModel model) {
    auto scene = std::make_shared<LoadedScene>();
    scene->patches = std::move(model);
    show(scene);
  }
  void show(const std::shared_ptr<const LoadedScene>& scene) {
    session_.navigator.set_model(without_patches(scene->patches), false);
    const Status shown = display_->show(scene, session_);
    ASSERT_TRUE(shown) << shown.error().message;
  }
  /// Draws until the picture is complete.
  void finish() {
    Status status = display_->update(session_, true);
    for (int k = 0; k < 1000 && status && !display_->is_complete(); ++k)
      status = display_->update(session_, false);
    ASSERT_TRUE(status) << status.error().message;
    ASSERT_TRUE(display_->is_complete());
  }
  [[nodiscard]] Image picture() const {
    const Canvas& canvas = *display_->picture();
    return read_colour(context_->gl(), canvas.colour, canvas.width, canvas.height);
  }
  [[nodiscard]] std::vector<float> green() const { return picture().find("G")->values; }

  ScratchFolder folder_;
  std::optional<OwnContext> context_;
  std::unique_ptr<Display> display_;
  Session session_;
};

}  // namespace relief::test

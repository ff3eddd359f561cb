// Any input leaves a camera that can be drawn.
#include <gtest/gtest.h>

#include <random>

#include "ball.h"
#include "common/scene/scene.h"

namespace relief {
namespace {

/// Someone who presses, turns and drags at random.
class Walker {
 public:
  Walker(Navigator& navigator, const Ball& ball, unsigned seed)
      : navigator_(navigator), ball_(ball), random_(seed) {}

  void step() {
    switch (whole(16)) {
      case 0:
        return navigator_.begin(static_cast<DragKind>(whole(5)), move_cursor(), under());
      case 1:
      case 2:
      case 3:
      case 4:
        return navigator_.drag(move_cursor());
      case 5:
        return navigator_.end();
      case 6:
      case 7:
        return navigator_.zoom(between(-4.0, 6.0), move_cursor(), under());
      case 8:
        return navigator_.pan({between(-50, 50), between(-50, 50)}, move_cursor(), under());
      case 9:
      case 10:
        return navigator_.fly({between(-1, 1), between(-1, 1), between(-1, 1)}, between(0, 0.2),
                              between(0, 5), under());
      case 11:
      case 12:
        navigator_.advance(between(0, 0.2));
        return;
      case 13:
        return resize();
      case 14:
        return view();
      default:
        return setting();
    }
  }

 private:
  int whole(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  glm::dvec2 move_cursor() {
    cursor_ = {between(-0.5, 1.5) * size_.x, between(-0.5, 1.5) * size_.y};
    return cursor_;
  }

  /// Mostly what a viewer picks; sometimes what a wrong one might.
  std::optional<glm::dvec3> under() {
    if (whole(40) == 0) return glm::dvec3(NAN, 0.0, INFINITY);
    if (whole(40) == 0) return navigator_.camera().eye;
    if (whole(40) == 0)
      return ball_.centre + 5.0 * ball_.radius * glm::dvec3(between(-1, 1), 0, between(-1, 1));
    return pick(ball_, navigator_.camera(), cursor_, size_);
  }

  void resize() {
    ImageSize size{static_cast<std::uint32_t>(1 + whole(2000)),
                   static_cast<std::uint32_t>(1 + whole(2000))};
    if (whole(3) == 0) size = {1, 1};
    if (whole(5) == 0) size = {0, 0};
    navigator_.set_image(size);
    size_ = glm::max(glm::dvec2(size.width, size.height), glm::dvec2(1.0));
  }

  void view() {
    switch (whole(8)) {
      case 0:
        return navigator_.home();
      case 1:
        return navigator_.frame_all();
      case 2:
        return navigator_.frame(std::array{ball_.centre});
      case 3:
        return navigator_.roll(between(-200, 200));
      case 4:
        return navigator_.level();
      case 5:
        return navigator_.set_camera(
            {ball_.centre + glm::dvec3(0, 0, between(1.1, 5.0) * ball_.radius), ball_.centre,
             whole(2) == 0 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0), 45.0,
             whole(2) == 0 ? ball_.radius : 0.0});
      default:
        return navigator_.look_from(kViews.at(static_cast<std::size_t>(whole(7))).value);
    }
  }

  void setting() {
    switch (whole(5)) {
      case 0:
        return navigator_.set_orthographic(whole(2) == 0);
      case 1:
        return navigator_.set_field_of_view(between(-10, 200));
      case 2:
        return navigator_.set_orbit_style(static_cast<OrbitStyle>(whole(2)));
      case 3:
        return navigator_.set_up_axis(kAxes.at(static_cast<std::size_t>(whole(6))).value);
      default:
        return navigator_.set_model(extent_of(ball_), whole(2) == 0);
    }
  }

  Navigator& navigator_;
  const Ball& ball_;
  std::mt19937 random_;
  glm::dvec2 size_ = kSize;
  glm::dvec2 cursor_{0.0};
};

TEST(RandomWalk, LeavesACameraThatCanBeDrawn) {
  for (const Ball& ball : {Ball{}, Ball{kUtm, 100.0, 0.01}, Ball{{-3, 2, 1}, 1e-3, 0.0}}) {
    for (const unsigned seed : {1U, 2U, 3U}) {
      Navigator navigator = navigator_about(ball);
      Walker walker(navigator, ball, seed);
      for (int i = 0; i < 10000; ++i) {
        walker.step();
        const Camera& camera = navigator.camera();
        ASSERT_TRUE(is_usable(camera)) << "seed " << seed << ", step " << i;
        const glm::dvec3 up = glm::normalize(camera.up);
        ASSERT_GT(glm::length(glm::cross(up, backward_of(camera))), 1e-7);
        // At 0.01 degrees an image shows kFarthestRadii from 570,000 of them.
        ASSERT_LT(glm::distance(camera.eye, ball.centre), 1e6 * ball.radius);
        ASSERT_TRUE(std::isfinite(glm::length(navigator.pivot())));
      }
    }
  }
}

}  // namespace
}  // namespace relief

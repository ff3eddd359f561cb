// Pictures of a window's view have the bytes of `relief render`.
#include "viewer/pictures/picture_job.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>

#include "common/patch_file/patch_file.h"
#include "common/patch_file/patch_tree.h"
#include "common/scene/views/view_camera.h"
#include "loader/command/render_command.h"
#include "loader/scene/first_look.h"
#include "loader/scene/view_settings.h"
#include "tests/cli/run_relief.h"

namespace relief::test {
namespace {

class Picture : public CliTest {
 protected:
  /// What a window asks for that shows a file from a camera of its own.
  PictureRequest request_of(const std::string& file, const std::string& picture) {
    PictureRequest request;
    request.file = path(picture);
    request.plan = *plan_scene(file, {});
    Progress silent;
    auto scene = load_scene(request.plan, {}, silent);
    EXPECT_TRUE(scene) << scene.error().message;
    request.scene = std::make_shared<const LoadedScene>(*std::move(scene));
    const PlannedView& view = request.plan.views.front();
    RenderSettings settings = *render_settings_of(request.plan, view, request.scene->patches);
    complete_look(view, *request.scene, settings);
    settings.camera = camera_from({0.3, 0.6, 1.0}, request);
    settings.width = 90;
    settings.height = 70;
    request.views = {settings};
    return request;
  }
  /// Looks at the model's middle along a direction, near enough to leave some of it out.
  static Camera camera_from(glm::dvec3 direction, const PictureRequest& request) {
    const PatchModel& model = request.scene->patches;
    Camera camera;
    camera.target = 0.5 * (model.bounds.min + model.bounds.max);
    camera.eye = camera.target +
                 0.6 * glm::length(model.bounds.max - model.bounds.min) * glm::normalize(direction);
    return camera;
  }
  /// Makes the picture, and another one by the command for it.
  void expect_same_bytes(const PictureRequest& request) {
    Progress silent;
    const Status made = make_picture(request, silent);
    ASSERT_TRUE(made) << made.error().message;
    const std::string own = file_bytes(request.file.string());
    ASSERT_FALSE(own.empty());
    CommandedImage image;
    image.output = path("command" + request.file.extension().string());
    image.exposure = request.exposure;
    const auto command = render_command(request.plan, *request.scene, request.views.front(), image);
    ASSERT_TRUE(command) << command.error().message;
    EXPECT_TRUE(command->missing.empty());
    const std::string line = RELIEF_PROGRAM + command->line.substr(sizeof "relief" - 1);
    ASSERT_EQ(std::system((line + " >/dev/null").c_str()), 0) << line;  // NOLINT: as a user does
    EXPECT_EQ(own, file_bytes(image.output.string())) << line;
  }
};

TEST_F(Picture, OfAScanThatIsShown) {
  PictureRequest request = request_of(write_knot(1500), "picture.png");
  EXPECT_TRUE(serves(*request.scene, request));
  request.exposure = 0.5;
  request.views.front().background.reset();
  expect_same_bytes(request);
}

TEST_F(Picture, AsAnExrWithAllOutputs) {
  PictureRequest request = request_of(write_knot(1500), "picture.exr");
  request.views.front().outputs = {true, true, true, true};
  expect_same_bytes(request);
}

TEST_F(Picture, ReadsTheTilesOfItsView) {
  const PictureRequest of_scan = request_of(write_knot(3000), "none.png");
  const PatchModel& model = of_scan.scene->patches;
  const std::size_t half = model.patches.size() / 2;
  ASSERT_GE(half, 1U);
  const auto write_part = [&](const char* name, std::size_t first, std::size_t last, double scale) {
    PatchModel part = model;
    const auto begin = model.patches.begin();
    part.patches.assign(begin + static_cast<std::ptrdiff_t>(first),
                        begin + static_cast<std::ptrdiff_t>(last));
    part.joined.clear();
    for (Patch& patch : part.patches) patch.spacing *= scale;
    part.spacing *= scale;
    EXPECT_TRUE(write_patch_file(path(name), part, {}));
  };
  // A part stands for both of the others from afar.
  write_part("top", 0, half, 8.0);
  write_part("left", 0, half, 1.0);
  write_part("right", half, model.patches.size(), 1.0);
  const std::string file = path("knot.relief");
  ASSERT_TRUE(write_patch_tree(
      file, {{{path("top"), 1, kNoTile}, {path("left"), 0, 0}, {path("right"), 0, 0}}}, model));
  PictureRequest request = request_of(file, "picture.png");
  EXPECT_FALSE(serves(*request.scene, request));
  expect_same_bytes(request);
}

TEST_F(Picture, FilmAsNumberedFrames) {
  PictureRequest request = request_of(write_knot(1500), "film.png");
  request.is_film = true;
  request.views.resize(3, request.views.front());
  request.views[1].camera = camera_from({1.0, 0.2, 0.1}, request);
  Progress silent;
  const Status made = make_picture(request, silent);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_FALSE(file_bytes(path("film_0000.png")).empty());
  EXPECT_EQ(file_bytes(path("film_0000.png")), file_bytes(path("film_0002.png")));
  EXPECT_NE(file_bytes(path("film_0000.png")), file_bytes(path("film_0001.png")));
}

TEST_F(Picture, InTheBackgroundAndCancelled) {
  PictureRequest request = request_of(write_knot(1500), "film.png");
  const auto wait = [](PictureJob& job) -> std::optional<Status> {
    for (int k = 0; k < 6000; ++k) {
      if (auto result = job.take_result()) return result;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return std::nullopt;
  };
  PictureJob whole(request);
  const auto made = wait(whole);
  ASSERT_TRUE(made);
  EXPECT_TRUE(*made);
  EXPECT_FALSE(file_bytes(path("film.png")).empty());
  request.is_film = true;
  request.views.resize(2000, request.views.front());
  PictureJob job(request);
  job.cancel();
  const auto cancelled = wait(job);
  ASSERT_TRUE(cancelled);
  EXPECT_FALSE(*cancelled);
  EXPECT_TRUE(file_bytes(path("film_1999.png")).empty());
}

TEST_F(Picture, NamesAndFailures) {
  EXPECT_TRUE(check_picture_name("a.PNG", false));
  EXPECT_TRUE(check_picture_name("a.exr", true));
  EXPECT_TRUE(check_picture_name("a.mp4", true));
  EXPECT_FALSE(check_picture_name("a.mp4", false));
  EXPECT_EQ(check_picture_name("a.jpg", false).error().message,
            "a.jpg: a picture is a .png or .exr");
  const std::string first = path("dragon.png");
  EXPECT_EQ(free_path(first), first);
  write("dragon.png", "taken");
  write("dragon-2.png", "taken");
  EXPECT_EQ(free_path(first), path("dragon-3.png"));
  PictureRequest request = request_of(write_knot(1500), "none/picture.png");
  Progress silent;
  const Status made = make_picture(request, silent);
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("none/picture.png"), std::string::npos);
}

}  // namespace
}  // namespace relief::test

// Files that are opened in the background.
#include "viewer/document/document.h"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <fstream>
#include <mutex>
#include <thread>

#include "models/knot_scan.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

class Opening : public testing::Test {
 protected:
  std::filesystem::path write(const char* name, const std::string& text) {
    test::spill(folder_ / name, text);
    return folder_ / name;
  }
  /// All that comes until the job has ended.
  Arrival wait(Document& document) {
    Arrival all;
    for (int k = 0; k < 3000 && document.is_loading(); ++k) {
      Arrival some = document.take();
      all.is_other |= some.is_other;
      if (some.points) {
        EXPECT_FALSE(some.scene) << "points come first";
        all.points = std::move(some.points);
      }
      if (some.scene) all.scene = std::move(some.scene);
      if (some.failure) all.failure = std::move(some.failure);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return all;
  }
  test::ScratchFolder folder_;
  std::atomic<int> woken_ = 0;
};

TEST_F(Opening, PointsComeFirstAndThenPatches) {
  Document document({}, [this] { ++woken_; });
  ASSERT_TRUE(document.open({write("knot.ply", knot_scan_ply(3000))}, {}));
  const Arrival arrival = wait(document);
  ASSERT_TRUE(arrival.points);
  EXPECT_GE(arrival.points->points.size(), 3000U);
  ASSERT_TRUE(arrival.scene);
  EXPECT_FALSE(arrival.scene->patches.patches.empty());
  EXPECT_TRUE(arrival.is_other);
  EXPECT_GE(woken_, 2);
}

TEST_F(Opening, AMissingFileChangesNothing) {
  Document document({}, [] {});
  const auto knot = write("knot.ply", knot_scan_ply(2000));
  ASSERT_TRUE(document.open({knot}, {}));
  wait(document);
  const Status missing = document.open({folder_ / "none.ply"}, {});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message, (folder_ / "none.ply").string() + ": there is no such file");
  EXPECT_EQ(document.files(), std::vector{knot});
}

TEST_F(Opening, ABrokenFileSaysWhy) {
  Document document({}, [] {});
  ASSERT_TRUE(document.open({write("broken.relief", "RELIEF?")}, {}));
  const Arrival arrival = wait(document);
  EXPECT_FALSE(arrival.scene);
  ASSERT_TRUE(arrival.failure);
  EXPECT_NE(arrival.failure->find("broken.relief"), std::string::npos);
}

TEST_F(Opening, AfterABrokenFileTheOneThatIsShownIsOpenAgain) {
  Document document({}, [] {});
  const auto knot = write("knot.ply", knot_scan_ply(2000));
  ASSERT_TRUE(document.open({knot}, {}));
  wait(document);
  ASSERT_TRUE(document.open({write("broken.relief", "RELIEF?")}, {}));
  EXPECT_EQ(document.plan().models.front().file, knot) << "it is shown while others are loaded";
  const Arrival arrival = wait(document);
  EXPECT_TRUE(arrival.failure);
  EXPECT_FALSE(arrival.is_other) << "camera and look stay";
  EXPECT_EQ(document.files(), std::vector{knot});
  EXPECT_EQ(document.plan().models.front().file, knot);
  write("knot.ply", knot_scan_ply(2500));
  EXPECT_FALSE(document.has_changed_on_disk());
  EXPECT_TRUE(document.has_changed_on_disk()) << "it is watched again";
}

TEST_F(Opening, AfterACancelledJobTheOneThatIsShownIsOpenAgain) {
  Document document({}, [] {});
  const auto knot = write("knot.ply", knot_scan_ply(2000));
  ASSERT_TRUE(document.open({knot}, {}));
  wait(document);
  ASSERT_TRUE(document.open({write("large.ply", knot_scan_ply(200000))}, {}));
  document.cancel();
  EXPECT_EQ(document.files(), std::vector{knot});
}

TEST_F(Opening, AJobThatIsCancelledEndsSoon) {
  Document document({}, [] {});
  ASSERT_TRUE(document.open({write("knot.ply", knot_scan_ply(200000))}, {}));
  const auto start = std::chrono::steady_clock::now();
  document.cancel();
  // A few hundred milliseconds by promise; a busy machine takes longer.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  EXPECT_FALSE(document.is_loading());
}

TEST_F(Opening, AChangedFileIsNoticedOnceItIsComplete) {
  Document document({}, [] {});
  const auto knot = write("knot.ply", knot_scan_ply(2000));
  ASSERT_TRUE(document.open({knot}, {}));
  wait(document);
  EXPECT_FALSE(document.has_changed_on_disk());
  write("knot.ply", knot_scan_ply(2500));
  EXPECT_FALSE(document.has_changed_on_disk()) << "it may still be growing";
  EXPECT_TRUE(document.has_changed_on_disk());
  document.reload({});
  const Arrival arrival = wait(document);
  ASSERT_TRUE(arrival.scene);
  EXPECT_FALSE(arrival.is_other) << "the camera stays";
  std::filesystem::remove(knot);
  for (int k = 0; k < 3; ++k) EXPECT_FALSE(document.has_changed_on_disk());
}

TEST_F(Opening, ASceneFileIsOpenedAlone) {
  Document document({}, [] {});
  const auto knot = write("knot.ply", knot_scan_ply(2000));
  const auto scene = write("scene.json", R"({"models": [{"file": "knot.ply"}]})");
  EXPECT_FALSE(document.open({knot, scene}, {}));
  ASSERT_TRUE(document.open({knot}, {}));
  wait(document);
  const auto other = write("other.ply", knot_scan_ply(1500));
  ASSERT_TRUE(document.add({other, knot}, {}));
  EXPECT_EQ(document.files(), (std::vector{knot, other}));
  EXPECT_TRUE(wait(document).scene);
}

}  // namespace
}  // namespace relief

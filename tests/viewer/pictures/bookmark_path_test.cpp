// Camera paths through bookmarks.
#include "viewer/pictures/bookmark_path.h"

#include <gtest/gtest.h>

namespace relief {
namespace {

Camera camera_from(glm::dvec3 eye) {
  Camera camera;
  camera.eye = eye;
  return camera;
}

TEST(BookmarkPath, GoesThroughThemInTheirOrderAndTimes) {
  Bookmarks bookmarks;
  EXPECT_FALSE(path_through(bookmarks, {}));
  bookmarks.add("a", camera_from({0.0, 0.0, 5.0}));
  EXPECT_FALSE(path_through(bookmarks, {})) << "one camera is no path";
  bookmarks.add("b", camera_from({5.0, 0.0, 1.0}));
  bookmarks.add("c", camera_from({0.0, 5.0, 1.0}));
  bookmarks.set_seconds(0, 1.5);
  bookmarks.set_seconds(1, 3.0);
  const auto path = path_through(bookmarks, {25.0, false});
  ASSERT_TRUE(path);
  ASSERT_EQ(path->keys.size(), 3U);
  EXPECT_EQ(path->keys[1].name, "b");
  EXPECT_EQ(duration_of(*path), 4.5);
  EXPECT_EQ(path->frames_per_second, 25.0);
  EXPECT_EQ(camera_at(*path, 1.5).eye, glm::dvec3(5.0, 0.0, 1.0));
  // A leg goes along with the bookmark that it begins at.
  bookmarks.move(1, 0);
  const auto moved = path_through(bookmarks, {25.0, true});
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->keys[1].time, 3.0);
  EXPECT_EQ(moved->keys[2].time, 4.5);
  // Back to the first in the mean of both legs.
  EXPECT_EQ(duration_of(*moved), 6.75);
}

TEST(BookmarkPath, IsOfOneProjection) {
  Bookmarks bookmarks;
  bookmarks.add("wide", camera_from({0.0, 0.0, 5.0}));
  Camera flat = camera_from({5.0, 0.0, 1.0});
  flat.orthographic_height = 2.0;
  bookmarks.add("flat", flat);
  const auto path = path_through(bookmarks, {});
  ASSERT_FALSE(path);
  EXPECT_EQ(path.error().message, "flat: a path is perspective or orthographic from end to end");
}

}  // namespace
}  // namespace relief

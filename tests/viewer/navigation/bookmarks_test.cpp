#include "viewer/navigation/bookmarks.h"

#include <gtest/gtest.h>

#include "viewer/navigation/file_bookmarks.h"

namespace relief {
namespace {

Camera camera_at(double x) {
  return {{x, 0, 1}, {x, 0, 0}};
}

std::string names_of(const Bookmarks& bookmarks) {
  std::string names;
  for (const Bookmark& bookmark : bookmarks.list()) names += bookmark.name + ";";
  return names;
}

Bookmarks four() {
  Bookmarks bookmarks;
  for (const char* name : {"a", "b", "c", "d"}) bookmarks.add(name, camera_at(1.0));
  return bookmarks;
}

TEST(Bookmarks, HaveNamesThatDiffer) {
  Bookmarks bookmarks;
  EXPECT_EQ(bookmarks.add("door", camera_at(1.0)), 0U);
  EXPECT_EQ(bookmarks.add("door", camera_at(2.0)), 1U);
  bookmarks.add("", camera_at(3.0));
  bookmarks.add("", camera_at(4.0));
  EXPECT_EQ(names_of(bookmarks), "door;door 2;view;view 2;");
  bookmarks.rename(0, "view 2");
  bookmarks.rename(1, "door 2");
  EXPECT_EQ(names_of(bookmarks), "view 2 2;door 2;view;view 2;");
  EXPECT_EQ(bookmarks.list()[1].camera.eye.x, 2.0);
  bookmarks.replace(1, camera_at(9.0));
  EXPECT_EQ(bookmarks.list()[1].camera.eye.x, 9.0);
}

TEST(Bookmarks, KeepTheSelectionWhenOthersGo) {
  Bookmarks bookmarks = four();
  EXPECT_EQ(bookmarks.selected(), 3U);
  bookmarks.select(2);
  bookmarks.remove(0);
  EXPECT_EQ(bookmarks.list()[*bookmarks.selected()].name, "c");
  bookmarks.remove(2);
  EXPECT_EQ(bookmarks.list()[*bookmarks.selected()].name, "c");
  bookmarks.remove(1);
  EXPECT_FALSE(bookmarks.selected());
  EXPECT_EQ(names_of(bookmarks), "b;");
}

TEST(Bookmarks, MoveWithTheirSelection) {
  for (std::size_t from = 0; from < 4; ++from) {
    for (std::size_t to = 0; to < 4; ++to) {
      for (std::size_t selected = 0; selected < 4; ++selected) {
        Bookmarks bookmarks = four();
        bookmarks.select(selected);
        const std::string name = bookmarks.list()[selected].name;
        const std::string moved = bookmarks.list()[from].name;
        bookmarks.move(from, to);
        EXPECT_EQ(bookmarks.list()[to].name, moved);
        EXPECT_EQ(bookmarks.list()[*bookmarks.selected()].name, name);
      }
    }
  }
}

TEST(Bookmarks, AreSteppedThroughInARing) {
  Bookmarks bookmarks;
  EXPECT_FALSE(bookmarks.select_next());
  EXPECT_FALSE(bookmarks.select_previous());
  bookmarks = four();
  EXPECT_EQ(bookmarks.select_next(), 0U);
  EXPECT_EQ(bookmarks.select_previous(), 3U);
  bookmarks.select(std::nullopt);
  EXPECT_EQ(bookmarks.select_previous(), 3U);
  bookmarks.select(std::nullopt);
  EXPECT_EQ(bookmarks.select_next(), 0U);
}

TEST(Bookmarks, AreReplacedByOthersWhoseNamesDiffer) {
  Bookmarks bookmarks = four();
  bookmarks.assign({{"door", camera_at(1.0), 3.0}, {"door", camera_at(2.0)}});
  EXPECT_EQ(names_of(bookmarks), "door;door 2;");
  EXPECT_EQ(bookmarks.list().front().seconds, 3.0);
  EXPECT_FALSE(bookmarks.selected());
}

TEST(FileBookmarks, AreOfTheFileThatWasUsedLastFirst) {
  std::vector<FileBookmarks> all;
  keep_bookmarks(all, "/a.relief", four().list());
  keep_bookmarks(all, "/b.relief", {{"b", camera_at(2.0)}});
  keep_bookmarks(all, "/a.relief", {{"a", camera_at(1.0)}});
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all.front().file, "/a.relief");
  EXPECT_EQ(bookmarks_of(all, "/a.relief").size(), 1U);
  EXPECT_TRUE(bookmarks_of(all, "/c.relief").empty());
  keep_bookmarks(all, "/b.relief", {});
  EXPECT_EQ(all.size(), 1U);
}

TEST(FileBookmarks, AreKeptOfSoManyFiles) {
  std::vector<FileBookmarks> all;
  for (std::size_t k = 0; k < kMostBookmarkedFiles + 5; ++k)
    keep_bookmarks(all, "/" + std::to_string(k), four().list());
  EXPECT_EQ(all.size(), kMostBookmarkedFiles);
  EXPECT_TRUE(bookmarks_of(all, "/4").empty());
}

}  // namespace
}  // namespace relief

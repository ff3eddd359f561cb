// What a session of the window keeps.
#include "viewer/session.h"

#include <gtest/gtest.h>

#include "tests/common/patch_file/sample_models.h"
#include "viewer/remember.h"

namespace relief {
namespace {

TEST(Messages, GoWhenTheyHaveBeenReadAndErrorsLater) {
  Session session(Document({}, [] {}));
  add_message(session, "a note", false, 10.0);
  add_message(session, "an error", true, 10.0);
  EXPECT_FALSE(drop_old_messages(session, 15.0));
  EXPECT_EQ(session.messages.size(), 2U);
  EXPECT_TRUE(drop_old_messages(session, 17.0));
  ASSERT_EQ(session.messages.size(), 1U);
  EXPECT_TRUE(session.messages.front().is_error);
  EXPECT_TRUE(drop_old_messages(session, 31.0));
  EXPECT_TRUE(session.messages.empty());
}

TEST(BookmarksOfFiles, AreThereAgainWhenTheFileIsOpenedAgain) {
  const test::ScratchFolder folder;
  const char* const text = "0 0 0\n1 0 0\n0 1 0\n";
  for (const char* const name : {"a.xyz", "b.xyz"}) test::spill(folder / name, text);
  Session session(Document({}, [] {}));
  const auto open = [&](const char* name) {
    ASSERT_TRUE(session.document.open({folder / name}, {}));
    follow_bookmarks(session);
  };
  open("a.xyz");
  session.bookmarks.add("door", Camera());
  open("b.xyz");
  EXPECT_TRUE(session.bookmarks.empty());
  open("a.xyz");
  ASSERT_EQ(session.bookmarks.size(), 1U);
  session.bookmarks.add("window", Camera());
  session.document.close();
  follow_bookmarks(session);
  EXPECT_TRUE(session.bookmarks.empty());
  ASSERT_EQ(session.preferences.bookmarks.size(), 1U);
  EXPECT_EQ(session.preferences.bookmarks.front().list.size(), 2U);
}

}  // namespace
}  // namespace relief

// What a session of the window keeps.
#include "viewer/session.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace relief

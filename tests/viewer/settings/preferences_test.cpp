#include "viewer/settings/preferences.h"

#include <gtest/gtest.h>

#include <string>

namespace relief {
namespace {

Preferences some() {
  Preferences made;
  made.window = {1600, 900};
  made.shows_panels = false;
  made.sections = {{"Look", false}, {"Files", true}};
  made.recent_files = {"/scans/dragon.relief", "/scans/ \"quoted\" \xC3\xA9.ply"};
  made.recent_environments = {"/env/studio.exr"};
  made.target_ms = 16.5;
  made.orbit_style = OrbitStyle::Trackball;
  made.material.ior = 1.25F;
  made.material.absorption = {0.5F, 1.0F, 100.0F};
  made.material.roughness = 0.375F;
  // At coordinates of surveys, to the last bit.
  const Camera near{
      {470013.123456789, 4430001.1, 1802.3}, {470013.0, 4430002.0, 1801.0}, {0, 0, 1}};
  Camera far = near;
  far.orthographic_height = 12.5;
  made.bookmarks = {{"/scans/dragon.relief", {{"door \xC3\xA9", near, 0.5}, {"map", far}}},
                    {"/scans/b.ply", {{"b", Camera()}}}};
  return made;
}

std::string refusal(std::string_view text) {
  const auto read = parse_preferences(text, "viewer.json");
  return read ? std::string("read") : read.error().message;
}

TEST(Preferences, SurviveTheWayThroughText) {
  const auto read = parse_preferences(preferences_text(some()), "viewer.json");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(*read, some());
}

TEST(Preferences, AreThoseOfAFirstRunWhereNothingIsSaid) {
  const auto read = parse_preferences("{}", "viewer.json");
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, Preferences());
}

TEST(Preferences, IgnoreWhatALaterVersionWrote) {
  const auto read = parse_preferences(R"({"target_ms": 20, "holograms": {"on": true}})", "x");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->target_ms, 20.0);
}

TEST(Preferences, RefuseInOneSentenceThatNamesThePlace) {
  EXPECT_EQ(refusal(R"({"target_ms": 4.9})"),
            "viewer.json: target_ms: expected a number from 5 to 1000; found 4.9");
  EXPECT_EQ(refusal(R"({"window": [1280, 1e9]})"),
            "viewer.json: window[1]: expected a number from 200 to 16384; found 1000000000.0");
  EXPECT_EQ(refusal(R"({"orbit": "sideways"})"),
            "viewer.json: orbit: expected turntable, trackball; found \"sideways\"");
  EXPECT_EQ(refusal(R"({"sections": {"Look": 1}})"),
            "viewer.json: sections.Look: expected true or false; found 1");
  EXPECT_EQ(refusal(R"({"recent_files": "/a"})"),
            "viewer.json: recent_files: expected a list of paths, at least one; found \"/a\"");
}

TEST(Preferences, RefuseEveryTruncation) {
  const std::string text = preferences_text(some());
  for (std::size_t length = 0; length + 2 < text.size(); ++length)
    EXPECT_NE(refusal(text.substr(0, length)), "read") << length;
}

TEST(Preferences, SurviveAnyByteChanged) {
  // Whether it is read or refused: nothing else may happen.
  const std::string text = preferences_text(some());
  for (std::size_t at = 0; at < text.size(); ++at) {
    for (const char other : {'\0', '\xFF', '"', '[', '9', '-'}) {
      std::string damaged = text;
      damaged[at] = other;
      EXPECT_FALSE(refusal(damaged).empty());
    }
  }
}

TEST(Preferences, LeaveOutPathsThatCannotBeOnes) {
  const std::string longest(5000, 'a');
  const auto read = parse_preferences(
      R"({"recent_files": ["relative.ply", "/good.ply", "/nul\u0000.ply", "/)" + longest + "\"]}",
      "x");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->recent_files, std::vector<std::filesystem::path>{"/good.ply"});
}

TEST(Preferences, LeaveOutBookmarksThatCannotBeShown) {
  const auto read = parse_preferences(
      R"({"bookmarks": [{"file": "/a", "views": [{"name": "nowhere", "eye": [1, 1, 1],
          "target": [1, 1, 1]}, {"name": "good", "eye": [1, 2, 3], "later": 7}]},
          {"file": "relative", "views": [{"name": "lost"}]}]})",
      "x");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->bookmarks.size(), 1U);
  ASSERT_EQ(read->bookmarks.front().list.size(), 1U);
  EXPECT_EQ(read->bookmarks.front().list.front().name, "good");
  EXPECT_EQ(refusal(R"({"bookmarks": [{"file": "/a", "views": [{"fov": 200}]}]})"),
            "viewer.json: bookmarks[0].views[0].fov: expected degrees from 0.01 to 175; found 200");
  EXPECT_EQ(refusal(R"({"bookmarks": [{"views": []}]})"),
            "viewer.json: bookmarks[0].file: is missing; expected a path");
}

TEST(Preferences, LeaveOutPathsThatJsonCannotHold) {
  Preferences odd;
  odd.recent_files = {"/latin1-\xE9.ply", "/good.ply"};
  const auto read = parse_preferences(preferences_text(odd), "x");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->recent_files, std::vector<std::filesystem::path>{"/good.ply"});
}

TEST(Preferences, RememberTheLatestFirstEachOnce) {
  std::vector<std::filesystem::path> list;
  for (const char* path : {"/a", "/b", "/c", "/x/../a", "/d"}) remember(list, path, 3);
  EXPECT_EQ(list, (std::vector<std::filesystem::path>{"/d", "/a", "/c"}));
}

TEST(Preferences, RememberRelativePathsAsAbsoluteOnes) {
  std::vector<std::filesystem::path> list;
  remember(list, "scan.ply", 3);
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list.front(), std::filesystem::current_path() / "scan.ply");
}

}  // namespace
}  // namespace relief

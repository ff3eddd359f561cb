// The boxes that volumes are cut to: their texts, and where they lie.
#include "common/volume/clip_box.h"

#include <gtest/gtest.h>

#include <limits>

namespace relief {
namespace {

constexpr double kBeyond = std::numeric_limits<double>::infinity();

TEST(ClipBox, IsTwoCornersOfCoordinatesOrPercentages) {
  const auto box = parse_clip_box("-1.5,0%,+2,1e3,12.5%,100%");
  ASSERT_TRUE(box);
  EXPECT_EQ(box->low[0], (ClipSide{-1.5, false}));
  EXPECT_EQ(box->low[1], (ClipSide{0.0, true}));
  EXPECT_EQ(box->low[2], (ClipSide{2.0, false}));
  EXPECT_EQ(box->high[0], (ClipSide{1000.0, false}));
  EXPECT_EQ(box->high[1], (ClipSide{12.5, true}));
  EXPECT_EQ(box->high[2], (ClipSide{100.0, true}));
  EXPECT_EQ(parse_clip_box(text_of(*box)), box);
}

TEST(ClipBox, IsNothingElse) {
  for (const char* const text :
       {"", "1", "1,2,3", "1,2,3,4,5", "1,2,3,4,5,6,7", "1,2,3,4,5,", ",2,3,4,5,6", "1,2,3,4,5,x",
        "nan,0,0,1,1,1", "0,0,0,inf,1,1", "1e999,0,0,1,1,1", "-1%,0,0,1,1,1", "0,0,0,101%,1,1",
        "2,0,0,1,1,1", "0,50%,0,1,40%,1", "0 0 0 1 1 1", "0,0,0,1,1,1%%", "0,0,0, 1,1,1"})
    EXPECT_FALSE(parse_clip_box(text)) << text;
  EXPECT_TRUE(parse_clip_box("1,1,1,1,1,1")) << "a plane of nodes is not empty";
  EXPECT_TRUE(parse_clip_box("10,0,0,5%,1,1")) << "what that is depends on the model";
}

TEST(ClipBox, PercentagesAreOfTheExtentAndItsEndsCutNothing) {
  const Bounds extent{{-10.0, 0.0, 100.0}, {10.0, 1.0, 200.0}};
  const auto box = place_clip_box(*parse_clip_box("0%,25%,120,75%,0.9,100%"), extent);
  ASSERT_TRUE(box) << box.error().message;
  EXPECT_EQ(box->min, glm::dvec3(-kBeyond, 0.25, 120.0));
  EXPECT_EQ(box->max, glm::dvec3(5.0, 0.9, kBeyond));
  EXPECT_TRUE(holds(*box, {-1000.0, 0.25, 120.0}));
  EXPECT_FALSE(holds(*box, {5.1, 0.5, 150.0}));
  EXPECT_FALSE(holds(*box, {std::numeric_limits<double>::quiet_NaN(), 0.5, 150.0}));
}

TEST(ClipBox, ThatHoldsNothingSaysWhereTheModelIs) {
  const Bounds extent{{0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}};
  const auto beside = place_clip_box(*parse_clip_box("5,0,0,6,1,1"), extent);
  ASSERT_FALSE(beside);
  EXPECT_EQ(beside.error().message,
            "the clip box 5,0,0,6,1,1 holds nothing of the model, which reaches from 0,0,0 to "
            "1,2,3");
  EXPECT_FALSE(place_clip_box(*parse_clip_box("0.9,0,0,50%,1,1"), extent)) << "0.9 to 0.5";
}

}  // namespace
}  // namespace relief

// What clicks and keys make of measurements.
#include "viewer/measuring/tool.h"

#include <gtest/gtest.h>

namespace relief {
namespace {

SurfacePoint at(double x, double y = 0.0, double z = 0.0) {
  SurfacePoint point;
  point.position = {x, y, z};
  return point;
}

TEST(MeasuringTool, WithoutAToolClicksMeasureNothing) {
  MeasuringTool tool;
  tool.add(at(1.0));
  EXPECT_TRUE(tool.open_points().empty());
  EXPECT_TRUE(tool.list().empty());
  EXPECT_FALSE(tool.finish());
  EXPECT_FALSE(tool.remove_last());
  EXPECT_FALSE(tool.escape());
}

TEST(MeasuringTool, EndsAMeasurementWithItsLastPoint) {
  for (const auto kind : {MeasurementKind::Point, MeasurementKind::Distance,
                          MeasurementKind::Height, MeasurementKind::Angle}) {
    MeasuringTool tool;
    tool.choose(kind);
    for (std::size_t k = 0; k < points_of(kind); ++k) {
      EXPECT_TRUE(tool.list().empty());
      tool.add(at(static_cast<double>(k)));
    }
    ASSERT_EQ(tool.list().size(), 1U);
    EXPECT_TRUE(is_complete(tool.list().front()));
    EXPECT_EQ(tool.list().front().kind, kind);
    EXPECT_TRUE(tool.open_points().empty());
    EXPECT_EQ(tool.chosen(), kind) << "the next one follows";
  }
}

TEST(MeasuringTool, APolylineGoesOnUntilItIsEnded) {
  MeasuringTool tool;
  tool.choose(MeasurementKind::Polyline);
  tool.add(at(0.0));
  EXPECT_FALSE(tool.finish()) << "one point is no line";
  EXPECT_EQ(tool.open_points().size(), 1U);
  tool.add(at(1.0));
  tool.add(at(2.0));
  tool.add(at(4.0));
  EXPECT_TRUE(tool.remove_last());
  EXPECT_TRUE(tool.finish());
  ASSERT_EQ(tool.list().size(), 1U);
  EXPECT_EQ(tool.list().front().points.size(), 3U);
  EXPECT_EQ(copied_text(tool.list().front(), {0.0, 0.0, 1.0}), "2");
}

TEST(MeasuringTool, EscapeGivesUpFirstTheMeasurementAndThenTheTool) {
  MeasuringTool tool;
  tool.choose(MeasurementKind::Angle);
  tool.add(at(0.0));
  EXPECT_TRUE(tool.escape());
  EXPECT_TRUE(tool.open_points().empty());
  EXPECT_EQ(tool.chosen(), MeasurementKind::Angle);
  EXPECT_TRUE(tool.escape());
  EXPECT_FALSE(tool.chosen());
  EXPECT_FALSE(tool.escape());
}

TEST(MeasuringTool, AnotherToolDropsWhatIsOpen) {
  MeasuringTool tool;
  tool.choose(MeasurementKind::Distance);
  tool.add(at(0.0));
  tool.choose(MeasurementKind::Angle);
  EXPECT_TRUE(tool.open_points().empty());
  tool.add(at(0.0));
  tool.put_away();
  EXPECT_TRUE(tool.open_points().empty());
}

TEST(MeasuringTool, PreviewsWhatTheNextPointCompletes) {
  MeasuringTool tool;
  tool.choose(MeasurementKind::Angle);
  EXPECT_FALSE(tool.preview(at(1.0)));
  tool.add(at(1.0));
  EXPECT_FALSE(tool.preview(at(0.0))) << "a third point is still to come";
  tool.add(at(0.0));
  const auto preview = tool.preview(at(0.0, 3.0));
  ASSERT_TRUE(preview);
  EXPECT_DOUBLE_EQ(values_of(*preview, {0.0, 0.0, 1.0}).front().value, 90.0);
  EXPECT_EQ(tool.open_points().size(), 2U) << "nothing is added";
}

TEST(MeasuringTool, NamesAreNumberedOnAndCanBeChanged) {
  MeasuringTool tool;
  tool.choose(MeasurementKind::Point);
  tool.add(at(1.5, 2.25, 0.1));
  tool.add(at(2.0));
  tool.remove(0);
  tool.add(at(3.0));
  ASSERT_EQ(tool.list().size(), 2U);
  EXPECT_EQ(tool.list()[0].name, "point 2");
  EXPECT_EQ(tool.list()[1].name, "point 3") << "no name comes twice";
  tool.rename(0, "gate");
  EXPECT_EQ(tool.list()[0].name, "gate");
  tool.clear();
  EXPECT_TRUE(tool.list().empty());
}

TEST(MeasuringTool, CopiesEveryDigit) {
  const Measurement point{MeasurementKind::Point, {}, {at(500000.1, 5000000.123456789, -0.1)}};
  EXPECT_EQ(copied_text(point, {0.0, 0.0, 1.0}), "500000.1, 5000000.123456789, -0.1");
}

}  // namespace
}  // namespace relief

#include "common/scalars/scalar_names.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relief {
namespace {

TEST(ScalarNames, AreTheSameWhateverTheFormat) {
  EXPECT_EQ(canonical_scalar_name("Intensity"), "intensity");
  EXPECT_EQ(canonical_scalar_name("scalar_Intensity"), "intensity");  // CloudCompare
  EXPECT_EQ(canonical_scalar_name("class"), "classification");
  EXPECT_EQ(canonical_scalar_name("Return"), "return_number");
  EXPECT_EQ(canonical_scalar_name("returns"), "number_of_returns");
  EXPECT_EQ(canonical_scalar_name("Gps Time"), "gps_time");
  EXPECT_EQ(canonical_scalar_name("a\x01\xC3\xA9"), "a___");
  EXPECT_EQ(canonical_scalar_name(std::string(100, 'x')).size(), 63U);
  EXPECT_EQ(canonical_scalar_name("scalar_"), "scalar_");
}

TEST(ScalarNames, OfFilesNeverHideComputedOnes) {
  EXPECT_EQ(file_scalar_name("height"), "file_height");
  EXPECT_EQ(file_scalar_name("scalar_Distance"), "file_distance");
  EXPECT_EQ(file_scalar_name("quality"), "quality");
}

TEST(ScalarNames, SayWhichAreLabels) {
  for (const char* name : {"classification", "label", "segment_index", "return_number", "id",
                           "point_source_id", "instance", "number_of_returns"})
    EXPECT_TRUE(is_label_name(name)) << name;
  for (const char* name : {"intensity", "gps_time", "quality", "curvature", "scan_angle", "width"})
    EXPECT_FALSE(is_label_name(name)) << name;
  EXPECT_TRUE(are_labels({0, 65534, std::nan("")}));
  EXPECT_FALSE(are_labels({0.5}));
  EXPECT_FALSE(are_labels({-1}));
  EXPECT_FALSE(are_labels({65535}));
}

TEST(LasClasses, HaveTheNamesOfTheStandard) {
  EXPECT_EQ(las_class_name(2), "Ground");
  EXPECT_EQ(las_class_name(6), "Building");
  EXPECT_EQ(las_class_name(18), "High noise");
  EXPECT_EQ(las_class_name(22), "Temporal exclusion");
  EXPECT_EQ(las_class_name(23), "");
  EXPECT_EQ(las_class_name(255), "");
}

TEST(ScalarChoice, HasWhatIsNamedOrAll) {
  EXPECT_FALSE(ScalarChoice().has("intensity"));
  EXPECT_TRUE(ScalarChoice({true, {}}).has("intensity"));
  EXPECT_TRUE(ScalarChoice({false, {"intensity"}}).has("intensity"));
  EXPECT_FALSE(ScalarChoice({false, {"intensity"}}).has("time"));
}

}  // namespace
}  // namespace relief

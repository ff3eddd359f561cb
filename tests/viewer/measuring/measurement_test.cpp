// What measurements are worth, how they are written, and that files hold every digit.
#include "viewer/measuring/measurement.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "viewer/measuring/measurement_file.h"

namespace relief {
namespace {

constexpr glm::dvec3 kUp(0.0, 0.0, 1.0);

Measurement measurement_of(MeasurementKind kind, const std::vector<glm::dvec3>& positions) {
  Measurement measurement{kind, {}, {}};
  for (const glm::dvec3& position : positions) {
    SurfacePoint point;
    point.position = position;
    measurement.points.push_back(point);
  }
  return measurement;
}

double value_of(const Measurement& measurement, std::string_view name, glm::dvec3 up = kUp) {
  for (const MeasuredValue& value : values_of(measurement, up)) {
    if (value.name == name) return value.value;
  }
  ADD_FAILURE() << "no " << name;
  return 0.0;
}

TEST(Measurement, OfAFewPoints) {
  const glm::dvec3 far(5.0e5, 5.0e6, 100.0);
  const auto distance =
      measurement_of(MeasurementKind::Distance, {far, far + glm::dvec3(2.0, 3.0, 6.0)});
  EXPECT_DOUBLE_EQ(value_of(distance, "length"), 7.0);
  EXPECT_DOUBLE_EQ(value_of(distance, "horizontal_length"), std::sqrt(13.0));
  EXPECT_DOUBLE_EQ(value_of(distance, "height"), 6.0);
  // Along another up direction, of any length.
  EXPECT_DOUBLE_EQ(value_of(distance, "height", {0.0, -5.0, 0.0}), -3.0);
  const auto height = measurement_of(MeasurementKind::Height, {{1, 2, 9}, {1, 5, 2}});
  EXPECT_DOUBLE_EQ(value_of(height, "height"), -7.0);
  EXPECT_DOUBLE_EQ(value_of(height, "horizontal_length"), 3.0);
  const auto line =
      measurement_of(MeasurementKind::Polyline, {{0, 0, 0}, {3, 4, 0}, {3, 4, 12}, {0, 0, 12}});
  EXPECT_DOUBLE_EQ(value_of(line, "length"), 22.0);
  EXPECT_DOUBLE_EQ(value_of(line, "horizontal_length"), 10.0);
  EXPECT_DOUBLE_EQ(value_of(line, "height"), 12.0);
}

TEST(Measurement, OfAngles) {
  const auto angle = [](glm::dvec3 a, glm::dvec3 b) {
    const glm::dvec3 at(5.0e5, 5.0e6, 0.0);
    return value_of(measurement_of(MeasurementKind::Angle, {at + a, at, at + b}), "angle_degrees");
  };
  EXPECT_NEAR(angle({1, 0, 0}, {0, 3, 0}), 90.0, 1e-12);
  EXPECT_NEAR(angle({1, 0, 0}, {-2, 0, 0}), 180.0, 1e-12);
  EXPECT_NEAR(angle({1, 0, 0}, {1, 1, 0}), 45.0, 1e-12);
  EXPECT_EQ(angle({0, 0, 0}, {1, 1, 0}), 0.0);
}

TEST(Measurement, IsCompleteWithAllItsPoints) {
  EXPECT_FALSE(is_complete(measurement_of(MeasurementKind::Point, {})));
  EXPECT_TRUE(is_complete(measurement_of(MeasurementKind::Point, {{1, 2, 3}})));
  EXPECT_FALSE(is_complete(measurement_of(MeasurementKind::Distance, {{1, 2, 3}})));
  EXPECT_FALSE(is_complete(measurement_of(MeasurementKind::Polyline, {{1, 2, 3}})));
  EXPECT_TRUE(is_complete(measurement_of(MeasurementKind::Polyline, {{}, {}, {}, {}})));
  EXPECT_FALSE(is_complete(measurement_of(MeasurementKind::Angle, {{}, {}})));
}

TEST(Measurement, IsWrittenWithTheDigitsOfItsModel) {
  EXPECT_EQ(format_length(5212345.6789, 1.0), "5212345.679");
  EXPECT_EQ(format_length(5212345.6789, 0.5), "5212345.679");
  EXPECT_EQ(format_length(5212345.6789, 0.05), "5212345.6789");
  EXPECT_EQ(format_length(0.0123456789, 0.002), "0.01235");
  EXPECT_EQ(format_length(1234.5, 30.0), "1234.5");
  EXPECT_EQ(format_length(1234.5, 1e6), "1234");  // halves go to the even number
  EXPECT_EQ(format_length(-1e-9, 1.0), "0.000");
  // No digit that a double has not.
  EXPECT_EQ(format_length(5212345.0, 1e-12), "5212345.00000000");
  EXPECT_EQ(format_length(2.0, 0.0), "2.000");
  EXPECT_EQ(label_of(measurement_of(MeasurementKind::Point, {{1, -2, 3.25}}), kUp, 1.0),
            "1.000, -2.000, 3.250");
  EXPECT_EQ(label_of(measurement_of(MeasurementKind::Height, {{1, 2, 9}, {1, 5, 2}}), kUp, 1.0),
            "-7.000");
  EXPECT_EQ(
      label_of(measurement_of(MeasurementKind::Angle, {{1, 0, 0}, {0, 0, 0}, {0, 1, 1}}), kUp, 1.0),
      "90.00°");
}

TEST(Measurement, HasItsLabelInTheMiddle) {
  EXPECT_EQ(label_anchor(measurement_of(MeasurementKind::Point, {{1, 2, 3}})), glm::dvec3(1, 2, 3));
  EXPECT_EQ(label_anchor(measurement_of(MeasurementKind::Distance, {{1, 2, 3}, {3, 2, 3}})),
            glm::dvec3(2, 2, 3));
  EXPECT_EQ(
      label_anchor(measurement_of(MeasurementKind::Polyline, {{0, 0, 0}, {4, 0, 0}, {4, 2, 0}})),
      glm::dvec3(3, 0, 0));
  EXPECT_EQ(label_anchor(measurement_of(MeasurementKind::Distance, {{1, 2, 3}, {1, 2, 3}})),
            glm::dvec3(1, 2, 3));
  EXPECT_EQ(label_anchor(measurement_of(MeasurementKind::Angle, {{1, 0, 0}, {7, 8, 9}, {0, 1, 1}})),
            glm::dvec3(7, 8, 9));
}

/// Numbers that need all digits of a double.
std::vector<Measurement> awkward_measurements() {
  Measurement distance =
      measurement_of(MeasurementKind::Distance,
                     {{500000.1, 5.0e6 + 1.0 / 3.0, 0.1 + 0.2}, {1e-17, -0.0, 1e12 / 7.0}});
  distance.name = "eave, \"north\"";
  distance.points[0].colour = glm::u8vec3(1, 20, 255);
  distance.points[0].normal = glm::normalize(glm::dvec3(1.0, 2.0, 3.0));
  distance.points[0].patch = 0;
  distance.points[1].patch = 123456;
  return {distance, measurement_of(MeasurementKind::Distance, {{1, 2, 3}}),
          measurement_of(MeasurementKind::Point, {{1.1, 2.2, 3.3}})};
}

TEST(MeasurementFile, AsJsonReadsBackToTheBit) {
  const auto measurements = awkward_measurements();
  const auto json =
      nlohmann::json::parse(measurements_as_json(measurements, {"scan.laz", {0, 0, 1}}));
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["file"], "scan.laz");
  ASSERT_EQ(json["measurements"].size(), 2U) << "one lacks a point";
  const auto& entry = json["measurements"][0];
  EXPECT_EQ(entry["name"], "eave, \"north\"");
  EXPECT_EQ(entry["kind"], "distance");
  EXPECT_EQ(entry["length"].get<double>(), value_of(measurements[0], "length"));
  for (std::size_t k = 0; k < 2; ++k) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(entry["points"][k]["position"][c].get<double>(),
                measurements[0].points[k].position[c]);
      EXPECT_EQ(entry["points"][k]["normal"][c].get<double>(), measurements[0].points[k].normal[c]);
    }
  }
  EXPECT_EQ(entry["points"][0]["colour"], nlohmann::json({1, 20, 255}));
  EXPECT_TRUE(entry["points"][1]["colour"].is_null());
  EXPECT_EQ(entry["points"][1]["patch"], 123456);
  EXPECT_TRUE(json["measurements"][1]["points"][0]["patch"].is_null()) << "a point of kernels";
  EXPECT_FALSE(json["measurements"][1].contains("x")) << "a point has its position once";
}

TEST(MeasurementFile, KeepsJsonValidForNamesThatAreNoText) {
  auto measurements = awkward_measurements();
  measurements[0].name = "\xff\xfe";
  EXPECT_TRUE(nlohmann::json::accept(measurements_as_json(measurements, {"\xc3", {0, 0, 1}})));
}

TEST(MeasurementFile, AsCsvReadsBackToTheBit) {
  const auto measurements = awkward_measurements();
  std::istringstream table(measurements_as_csv(measurements, {"scan.laz", {0, 0, 1}}));
  std::string header;
  std::string first;
  std::string second;
  std::string third;
  std::getline(table, header);
  std::getline(table, first);
  std::getline(table, second);
  std::getline(table, third);
  EXPECT_EQ(header,
            "measurement,name,kind,point,x,y,z,normal_x,normal_y,normal_z,red,green,blue,patch,"
            "length,horizontal_length,height,angle_degrees");
  const std::string begin = "1,\"eave, \"\"north\"\"\",distance,1,";
  ASSERT_EQ(first.substr(0, begin.size()), begin);
  const char* at = first.data() + begin.size();
  for (int c = 0; c < 3; ++c) {
    double read = 0.0;
    at = std::from_chars(at, first.data() + first.size(), read).ptr + 1;
    EXPECT_EQ(read, measurements[0].points[0].position[c]);
  }
  EXPECT_NE(first.find(",1,20,255,0,"), std::string::npos) << first;
  EXPECT_EQ(second.substr(second.size() - 14), ",,,,123456,,,,") << second;
  EXPECT_EQ(third, "2,,point,1,1.1,2.2,3.3,0,0,1,,,,,,,,") << "a point of kernels has no patch";
}

TEST(MeasurementFile, IsWrittenByItsExtension) {
  const auto folder = std::filesystem::temp_directory_path() / "relief_measurement_test";
  std::filesystem::create_directories(folder);
  const auto measurements = awkward_measurements();
  const MeasurementSource model{"a.ply", {0, 1, 0}};
  ASSERT_TRUE(write_measurements(folder / "m.JSON", measurements, model));
  std::ifstream file(folder / "m.JSON");
  EXPECT_TRUE(nlohmann::json::accept(file));
  ASSERT_TRUE(write_measurements(folder / "m.csv", {}, model));
  const auto refused = write_measurements(folder / "m.txt", measurements, model);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("m.txt: measurements are written as .json or .csv"),
            std::string::npos);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace relief

// What is exported is read back with Relief's own readers.
#include "common/export/export.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "preprocess/readers/read_points.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief::test {
namespace {

constexpr double kTolerance = 1e-5;
const glm::dvec3 kUtm(515384.82325, 4918360.74175, 2330.73575);

/// 256 points about `origin` that have every value of a colour, and triangles between them.
Points sample_points(glm::dvec3 origin, bool with_triangles = true) {
  Points points;
  for (std::uint32_t k = 0; k < 256; ++k) {
    const double angle = 0.1 * k;
    points.positions.push_back(origin +
                               glm::dvec3(std::cos(angle), 0.01 * k - 1.0, std::sin(angle) / 3.0));
    points.normals.push_back(
        glm::normalize(glm::vec3(std::cos(angle), std::sin(angle), 0.01F * float(k))));
    const auto c = static_cast<std::uint8_t>(k);
    points.colours.emplace_back(c, 255 - c, c ^ 0x55U);
    if (with_triangles && k >= 2) points.triangles.push_back({k - 2, k, k - 1});
  }
  return points;
}

class ExportTest : public testing::Test {
 protected:
  /// Writes and reads back. The readers merge points at one place, of which there are none here.
  Points round_trip(const char* name, const Points& points) {
    Progress progress;
    const auto path = folder_ / name;
    const auto write = path.extension() == ".ply"   ? export_ply
                       : path.extension() == ".obj" ? export_obj
                                                    : export_glb;
    const Status written = write(path, {points, kTolerance}, progress);
    EXPECT_TRUE(written) << written.error().message;
    auto read = read_points(path, progress);
    if (!read) {
      ADD_FAILURE() << read.error().message;
      return {};
    }
    // Else a conversion would take the colour of a white material.
    EXPECT_TRUE(points.colours.empty() || read->points.materials.empty());
    return std::move(read->points);
  }

  /// `tolerance`: of coordinates; of normals' components, 1e-6.
  static void expect_same(const Points& read, const Points& points, double tolerance) {
    ASSERT_EQ(read.size(), points.size());
    EXPECT_EQ(read.colours, points.colours);
    EXPECT_EQ(read.triangles, points.triangles);
    ASSERT_EQ(read.normals.size(), points.normals.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      const glm::dvec3 off = glm::abs(read.positions[k] - points.positions[k]);
      EXPECT_LE(std::max({off.x, off.y, off.z}), tolerance) << k;
      // Normals of OBJ are the sums of their corners'.
      if (!points.normals.empty()) {
        const glm::vec3 n = glm::normalize(read.normals[k]) - points.normals[k];
        EXPECT_LT(glm::length(n), 2e-6F) << k;
      }
    }
  }

  [[nodiscard]] nlohmann::json document(const char* glb) const {
    const std::string bytes = slurp(folder_ / glb);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    return nlohmann::json::parse(bytes.substr(20, length));
  }

  ScratchFolder folder_;
};

/// Half the last bit of a float below 4: coordinates here are within 1.6 of `origin`.
constexpr double kFloatRounding = 1.0 / (1U << 23U);

TEST_F(ExportTest, PlyComesBack) {
  for (const bool mesh : {true, false}) {
    const Points near = sample_points({0.5, -0.5, 0.0}, mesh);
    expect_same(round_trip("near.ply", near), near, kFloatRounding);
    const Points far = sample_points(kUtm, mesh);
    expect_same(round_trip("far.ply", far), far, 0.0);
  }
  EXPECT_NE(slurp(folder_ / "near.ply").find("property float x\n"), std::string::npos);
  EXPECT_NE(slurp(folder_ / "far.ply").find("property double x\n"), std::string::npos);
}

TEST_F(ExportTest, ObjComesBackToTheLastBit) {
  for (const bool mesh : {true, false}) {
    const Points near = sample_points({0.1, 1e-9, 1e7}, mesh);
    expect_same(round_trip("near.obj", near), near, 0.0);
    const Points far = sample_points(kUtm, mesh);
    expect_same(round_trip("far.obj", far), far, 0.0);
  }
}

TEST_F(ExportTest, GlbComesBack) {
  for (const bool mesh : {true, false}) {
    const Points near = sample_points({0.5, -0.5, 0.0}, mesh);
    expect_same(round_trip("near.glb", near), near, kFloatRounding);
    // A float would be off by 0.25 here. The sum with the node's translation is a double's
    // rounding.
    const Points far = sample_points(kUtm, mesh);
    expect_same(round_trip("far.glb", far), far, kFloatRounding + 1e-9);
  }
}

TEST_F(ExportTest, GlbSaysWhatViewersNeed) {
  const Points near = sample_points({0.5, -0.5, 0.0});
  const Points far = sample_points(kUtm);
  round_trip("near.glb", near);
  round_trip("far.glb", far);
  EXPECT_FALSE(document("near.glb")["nodes"][0].contains("translation"));
  const auto json = document("far.glb");
  // Programs that keep a node's place as floats lose nothing.
  std::vector<double> origin = json["nodes"][0]["translation"];
  for (const double v : origin) {
    volatile float rounded = 0.0F;  // see rounded_to_float
    rounded = static_cast<float>(v);
    EXPECT_EQ(static_cast<double>(rounded), v);
  }
  // The stated bounds are those of the very floats.
  const std::string bytes = slurp(folder_ / "far.glb");
  std::uint32_t json_length = 0;
  std::uint32_t stated = 0;
  std::memcpy(&stated, bytes.data() + 8, 4);
  std::memcpy(&json_length, bytes.data() + 12, 4);
  EXPECT_EQ(stated, bytes.size());
  EXPECT_EQ(json_length % 4, 0U);
  std::vector<float> floats(3 * far.size());
  std::memcpy(floats.data(), bytes.data() + 20 + json_length + 8, 4 * floats.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float low = floats[axis];
    float high = floats[axis];
    for (std::size_t k = axis; k < floats.size(); k += 3) {
      low = std::min(low, floats[k]);
      high = std::max(high, floats[k]);
    }
    EXPECT_EQ(json["accessors"][0]["min"][axis].get<double>(), double{low});
    EXPECT_EQ(json["accessors"][0]["max"][axis].get<double>(), double{high});
  }
  EXPECT_EQ(json["materials"][0]["pbrMetallicRoughness"]["metallicFactor"], 0.0);
  EXPECT_EQ(json["materials"][0]["doubleSided"], true);
  EXPECT_FALSE(json["meshes"][0]["primitives"][0].contains("mode"));
  round_trip("points.glb", sample_points(kUtm, false));
  EXPECT_EQ(document("points.glb")["meshes"][0]["primitives"][0]["mode"], 0);
}

TEST_F(ExportTest, AttributesThatAreNotThereAreNotWritten) {
  Points bare = sample_points(kUtm);
  bare.normals.clear();
  bare.colours.clear();
  for (const char* name : {"bare.ply", "bare.obj", "bare.glb"}) {
    SCOPED_TRACE(name);
    expect_same(round_trip(name, bare), bare, kFloatRounding + 1e-9);
  }
}

TEST_F(ExportTest, DoublesAreTakenWhereFloatsAreTooCoarse) {
  Points points;
  EXPECT_FALSE(needs_doubles(points, 0.0));
  points.positions = {{-16777216.0, 0.0, 0.0}, {0.0, 1.0, 2.0}};  // 2^24: half a last bit is 1
  EXPECT_FALSE(needs_doubles(points, 1.0));
  EXPECT_TRUE(needs_doubles(points, 0.999));
}

class Cancelled : public Progress {
 public:
  [[nodiscard]] bool cancelled() const override { return true; }
};

TEST_F(ExportTest, AnInterruptLeavesNothing) {
  const Points points = sample_points(kUtm);
  Cancelled cancelled;
  for (const auto write : {export_ply, export_obj, export_glb}) {
    const Status written = write(folder_ / "x", {points, kTolerance}, cancelled);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().message, interrupted_error().message);
    EXPECT_EQ(folder_.count(), 0);
  }
}

}  // namespace
}  // namespace relief::test

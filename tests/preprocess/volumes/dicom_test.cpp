// DICOM series: where slices lie, what belongs together, and what is no series.
#include "preprocess/volumes/dicom/dicom.h"

#include <gtest/gtest.h>

#include <functional>

#include "preprocess/volumes/dicom/gdcm_slices.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/preprocess/volumes/dicom_files.h"
#include "tests/preprocess/volumes/volume_files.h"

namespace relief::test {
namespace {

class Dicom : public testing::Test {
 protected:
  /// Slice k of a stack whose value is 100 k + 10 row + column, written under a name that is not in
  /// its order.
  void write_slice(int k, const std::function<void(DicomFile&)>& change = {}) {
    DicomFile file;
    file.number = k + 1;
    file.position = "10\\20\\" + std::to_string(30.0 + 1.5 * k);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column)
        file.values.push_back(static_cast<std::int16_t>(100 * k + 10 * row + column));
    }
    if (change) change(file);
    spill(folder() / ("slice" + std::to_string((7 * k + 3) % 10)), dicom_bytes(file));
  }
  void write_stack(int slices, const std::function<void(DicomFile&)>& change = {}) {
    for (int k = 0; k < slices; ++k) write_slice(k, change);
  }
  Result<ScalarVolume> read(const std::filesystem::path& path) {
    Progress silent;
    return read_volume(path, {}, silent);
  }
  ScalarVolume must_read(const std::filesystem::path& path) {
    auto volume = read(path);
    if (volume) return *std::move(volume);
    ADD_FAILURE() << volume.error().message;
    return {};
  }
  void expect_error(const std::filesystem::path& path, const std::string& part) {
    const auto volume = read(path);
    ASSERT_FALSE(volume);
    EXPECT_NE(volume.error().message.find(part), std::string::npos) << volume.error().message;
    EXPECT_EQ(volume.error().message.find('\n'), std::string::npos) << volume.error().message;
  }
  [[nodiscard]] std::filesystem::path folder() const { return folder_.path(); }

  ScratchFolder folder_;
};

/// Tests that read files.
class DicomSeries : public Dicom {
 protected:
  void SetUp() override {
    if (!can_read_dicom()) GTEST_SKIP() << "this build has no GDCM";
  }
};

TEST_F(Dicom, IsKnownByItsMark) {
  write_stack(1);
  spill(folder_ / "notes.txt", "no image");
  EXPECT_TRUE(is_dicom(folder()));
  EXPECT_TRUE(is_dicom(folder_ / "slice3"));
  EXPECT_TRUE(is_volume(folder_ / "slice3", {}));
  EXPECT_FALSE(is_dicom(folder_ / "notes.txt"));
  EXPECT_FALSE(is_dicom(folder_ / "nothing"));
}

TEST_F(Dicom, WithoutGdcmASentenceNamesIt) {
  if (can_read_dicom()) GTEST_SKIP() << "this build has GDCM";
  write_stack(1);
  expect_error(folder(), "GDCM");
}

TEST_F(DicomSeries, SlicesLieWhereTheySay) {
  write_stack(5);
  spill(folder_ / "notes.txt", "no image");
  for (const std::filesystem::path& path : {folder(), folder_ / "slice3", folder_ / "slice0"}) {
    const ScalarVolume volume = must_read(path);
    ASSERT_EQ(volume.size, glm::uvec3(4, 3, 5));
    EXPECT_EQ(volume.stance.front, glm::dvec3(0.0, 1.0, 0.0)) << "faces the viewer";
    for_each_node(volume.size, [&](glm::uvec3 node) {
      EXPECT_EQ(volume.values[node.x + 4 * (node.y + 3 * std::size_t{node.z})],
                static_cast<float>(100 * node.z + 10 * node.y + node.x));
      // Left-posterior-superior becomes right-anterior-superior.
      const glm::dvec3 wanted(-10.0 - 0.5 * node.x, -20.0 - 2.0 * node.y, 30.0 + 1.5 * node.z);
      EXPECT_LT(glm::distance(node_position(volume, node), wanted), 1e-9);
    });
  }
}

TEST_F(DicomSeries, ValuesHaveTheFilesUnit) {
  write_stack(2, [](DicomFile& file) {
    file.slope = "0.5";
    file.intercept = "-1000";
  });
  EXPECT_EQ(must_read(folder()).values.back(), 0.5F * 123.0F - 1000.0F);
}

TEST_F(DicomSeries, ATiltedGantryShearsTheGrid) {
  write_stack(4, [](DicomFile& file) {
    file.position = "10\\" + std::to_string(20 + 0.3 * (file.number - 1)) + "\\" +
                    std::to_string(30 + 1.5 * (file.number - 1));
  });
  const ScalarVolume volume = must_read(folder());
  const glm::dvec3 wanted(-10.0, -20.9, 34.5);
  EXPECT_LT(glm::distance(node_position(volume, {0, 0, 3}), wanted), 1e-6);
}

TEST_F(DicomSeries, AMissingSliceLeavesAGap) {
  write_stack(6);
  std::filesystem::remove(folder_ / "slice4");  // k = 3
  const ScalarVolume volume = must_read(folder());
  ASSERT_EQ(volume.size, glm::uvec3(4, 3, 5));
  EXPECT_LT(glm::distance(node_position(volume, {0, 0, 3}), glm::dvec3(-10.0, -20.0, 36.0)), 1e-9);
  EXPECT_LT(glm::distance(node_position(volume, {3, 2, 4}), glm::dvec3(-11.5, -24.0, 37.5)), 1e-9);
  EXPECT_EQ(volume.values[3 * 12], 400.0F);
}

TEST_F(DicomSeries, SlicesWithoutPlacesAreInTheOrderOfTheirNumbers) {
  write_stack(3, [](DicomFile& file) { file.position.clear(); });
  const ScalarVolume volume = must_read(folder());
  EXPECT_EQ(volume.values[2 * 12], 200.0F);
  EXPECT_EQ(volume.stance, kZUp) << "nothing says how it stands";
}

TEST_F(DicomSeries, AFileChoosesItsSeries) {
  write_stack(3);
  for (int k = 5; k < 7; ++k) write_slice(k, [](DicomFile& file) { file.series = "1.2.4"; });
  expect_error(folder(), "holds 2 DICOM series; name a file of the one to read");
  EXPECT_EQ(must_read(folder_ / "slice3").size.z, 3U);
  EXPECT_EQ(must_read(folder_ / "slice8").size.z, 2U) << "k = 5";
}

TEST_F(DicomSeries, WhatIsNoStackIsOneSentence) {
  write_stack(3);
  write_slice(3, [](DicomFile& file) { file.position = "10\\20\\33"; });
  expect_error(folder(), "are slices at the same place");
  write_slice(3, [](DicomFile& file) { file.position = "12\\20\\34.5"; });
  expect_error(folder(), "lies beside the line");
  write_slice(3, [](DicomFile& file) {
    file.rows = 4;
    file.values.resize(16);
  });
  expect_error(folder(), "differ in size, spacing or direction");
}

TEST_F(DicomSeries, DamagedFilesAreOneSentence) {
  write_stack(2);
  const std::string whole = slurp(folder_ / "slice0");  // k = 1
  for (const std::size_t length : {whole.size() - 1, whole.size() - 20, std::size_t{300}}) {
    spill(folder_ / "slice0", whole.substr(0, length));
    const auto volume = read(folder_ / "slice0");
    ASSERT_FALSE(volume) << length;
    EXPECT_NE(volume.error().message.find("slice0: "), std::string::npos) << volume.error().message;
  }
  spill(folder_ / "slice0", whole.substr(0, 140));
  EXPECT_EQ(must_read(folder()).size.z, 1U) << "what has no image is left out of a folder";
}

}  // namespace
}  // namespace relief::test

// Image files of any format: other files are refused, real environments are read.
#include "tests/common/image/image_testing.h"

namespace relief {
namespace {

using test::failure;
using test::ScratchFolder;
using test::spill;
using test::values_of;

TEST(ReadImage, RefusesOtherFiles) {
  const ScratchFolder folder;
  spill(folder / "a.txt", "hello");
  EXPECT_EQ(failure(folder / "a.txt"),
            ": the image cannot be read: it is not an EXR, PNG, JPEG or Radiance HDR file");
  spill(folder / "empty.exr", "");
  EXPECT_EQ(failure(folder / "empty.exr"), ": the file is empty");
  EXPECT_EQ(failure(folder / "none.exr"), ": cannot be opened: no such file or directory");
  EXPECT_EQ(failure(folder.path()), ": is a directory, not a file");
}

TEST(ReadImage, ReadsRealEnvironments) {
  const auto envmaps = std::filesystem::path(RELIEF_TEST_DATA) / "../../../../shared/data/envmaps";
  if (!std::filesystem::exists(envmaps)) {
    GTEST_SKIP() << "needs the environments in ../shared/data/envmaps beside the checkout";
  }
  // Largest values as in the folder's manifest, to its number of digits.
  const std::pair<const char*, float> files[] = {{"city.exr", 3.395e4F},
                                                 {"courtyard.exr", 55.56F},
                                                 {"studio.exr", 118.4F},
                                                 {"sunset.exr", 6520.0F},
                                                 {"royal_esplanade_1k.hdr", 342.0F},
                                                 {"venice_sunset_1k.hdr", 6496.0F}};
  for (const auto& [name, largest] : files) {
    const auto image = read_image(envmaps / name);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->width, 1024U) << name;
    EXPECT_EQ(image->height, 512U) << name;
    float found = 0.0F;
    for (const char* channel : {"R", "G", "B"}) {
      const auto values = values_of(*image, channel);
      ASSERT_FALSE(values.empty()) << name << " " << channel;
      found = std::max(found, *std::max_element(values.begin(), values.end()));
    }
    EXPECT_NEAR(found, largest, 1e-3F * largest) << name;
  }
}

}  // namespace
}  // namespace relief

// An environment is decoded once.
#include "renderer/shading/environment/environment_cache.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "common/image/image_io.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

/// A small environment in a file that can be taken away.
std::filesystem::path write_grey_environment() {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      ("relief-environment-" + std::to_string(testing::UnitTest::GetInstance()->random_seed()) +
       testing::UnitTest::GetInstance()->current_test_info()->name() + ".exr");
  Image image{8, 4, {}};
  for (const char* const name : {"R", "G", "B"})
    image.channels.push_back({name, ChannelType::Half, std::vector<float>(8 * 4, 0.25F)});
  EXPECT_TRUE(write_exr(path, image));
  return path;
}

TEST(EnvironmentCache, DecodesOnceWhateverIsMadeOfIt) {
  const std::filesystem::path path = write_grey_environment();
  EnvironmentCache cache;
  const auto smooth = cache.get(path);
  ASSERT_TRUE(smooth) << smooth.error().message;
  std::filesystem::remove(path);
  EXPECT_EQ(*cache.get(path), *smooth);
  const auto rough = cache.get(path, 0.5F);  // of the decoded one: the file is gone
  ASSERT_TRUE(rough) << rough.error().message;
  EXPECT_EQ(*cache.get(path, 0.5F), *rough);
  EXPECT_FALSE(EnvironmentCache().get(path));
}

TEST(EnvironmentCache, IsSharedByTheEnginesOfACall) {
  const std::filesystem::path path = write_grey_environment();
  const PatchModel model = test::sphere_model({.spacing = 0.1});
  std::vector<RenderSettings> views;
  for (const char* const engine : {"onepass", "multipass", "ewa", "raytrace"}) {
    for (const float roughness : {0.0F, 0.4F}) {
      views.push_back(test::small_image(model, {}, 32));
      views.back().engine = engine;
      views.back().material = Material::Mirror;
      views.back().constants.roughness = roughness;
      views.back().environment = path;
    }
  }
  std::size_t images = 0;
  Progress silent;
  const Status drawn = render_views(
      RenderModel::of(model), views,
      [&](std::size_t /*view*/, const RenderResult& /*image*/) {
        std::filesystem::remove(path);  // after the first image nobody reads it again
        ++images;
        return Status();
      },
      silent);
  EXPECT_TRUE(drawn) << drawn.error().message;
  EXPECT_EQ(images, views.size());
}

}  // namespace
}  // namespace relief

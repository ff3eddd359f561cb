// What the tests of the image formats share.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "common/image/image_io.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief::test {

inline Channel make_channel(const char* name, ChannelType type, std::size_t count, float scale) {
  Channel channel{name, type, {}};
  for (std::size_t k = 0; k < count; ++k) {
    channel.values.push_back(scale * std::round(100.0F * std::sin(static_cast<float>(k) * 0.37F)));
  }
  return channel;
}

/// A channel's values; none if there is no such channel.
inline std::vector<float> values_of(const Image& image, const char* channel) {
  const Channel* found = image.find(channel);
  return found != nullptr ? found->values : std::vector<float>();
}

/// The message of what must fail; it starts with the file's name and is one sentence.
inline std::string failure(const std::filesystem::path& path) {
  const auto image = read_image(path);
  EXPECT_FALSE(image);
  if (image) return {};
  EXPECT_EQ(image.error().message.find(path.string()), 0U) << image.error().message;
  EXPECT_EQ(image.error().message.find('\n'), std::string::npos) << image.error().message;
  return image.error().message.substr(path.string().size());
}

}  // namespace relief::test

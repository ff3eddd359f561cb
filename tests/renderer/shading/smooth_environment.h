// An environment for tests.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include "common/image/image_io.h"

namespace relief::test {

/// An environment file without edges, so that one lookup a pixel is as good as many.
class SmoothEnvironment {
 public:
  SmoothEnvironment()
      : path_(std::filesystem::temp_directory_path() /
              ("relief-smooth-" + std::to_string(::getpid()) + ".exr")) {
    Image image{128, 64, {}};
    const char* const names[] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
      Channel channel{names[c], ChannelType::Float, {}};
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 128; ++x) {
          const double across = 2.0 * std::acos(-1.0) * (x + 0.5) / 128;
          const double down = std::acos(-1.0) * (y + 0.5) / 64;
          channel.values.push_back(static_cast<float>(
              0.5 + 0.3 * std::sin(down) * std::cos(across + 2.0 * c) + 0.15 * std::cos(down)));
        }
      }
      image.channels.push_back(std::move(channel));
    }
    EXPECT_TRUE(write_exr(path_, image));
  }
  ~SmoothEnvironment() { std::filesystem::remove(path_); }
  SmoothEnvironment(const SmoothEnvironment&) = delete;
  SmoothEnvironment& operator=(const SmoothEnvironment&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace relief::test

// Environments in files, for tests.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <utility>

#include "common/image/image_io.h"

namespace relief::test {

/// An equirectangular EXR that is gone after the test. Its light is `light(across, down)`: radians
/// from the left edge, 0 to 2 pi, and from straight up.
class EnvironmentFile {
 public:
  template <class Light>
  EnvironmentFile(const std::string& name, std::uint32_t height, const Light& light)
      : path_(std::filesystem::temp_directory_path() /
              ("relief-" + name + "-" + std::to_string(::getpid()) + ".exr")) {
    const double step = std::acos(-1.0) / height;
    Image image{2 * height, height, {}};
    const char* const names[] = {"R", "G", "B"};
    for (glm::length_t c = 0; c < 3; ++c) {
      Channel channel{names[c], ChannelType::Float, {}};
      for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < 2 * height; ++x) {
          const glm::dvec3 colour = light(step * (x + 0.5), step * (y + 0.5));
          channel.values.push_back(static_cast<float>(colour[c]));
        }
      }
      image.channels.push_back(std::move(channel));
    }
    EXPECT_TRUE(write_exr(path_, image));
  }
  ~EnvironmentFile() { std::filesystem::remove(path_); }
  EnvironmentFile(const EnvironmentFile&) = delete;
  EnvironmentFile& operator=(const EnvironmentFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// An environment without edges, so that one lookup a pixel is as good as many.
class SmoothEnvironment : public EnvironmentFile {
 public:
  SmoothEnvironment()
      : EnvironmentFile("smooth", 64, [](double across, double down) {
          const auto channel = [&](double c) {
            return 0.5 + 0.3 * std::sin(down) * std::cos(across + 2.0 * c) + 0.15 * std::cos(down);
          };
          return glm::dvec3(channel(0.0), channel(1.0), channel(2.0));
        }) {}
};

}  // namespace relief::test

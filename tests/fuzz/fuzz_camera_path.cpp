// Fuzzes the reader of camera paths, and the cameras between its keys.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "common/scene/views/camera_path.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);  // NOLINT
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto path = relief::parse_camera_path(text, "path");
  if (!path) return 0;
  const double begin = path->keys.front().time;
  for (const double part : {0.1, 0.5, 0.9}) {
    const relief::Camera camera =
        relief::camera_at(*path, begin + part * relief::duration_of(*path));
    const glm::dvec3 sum = camera.eye + camera.target + camera.up;
    relief::fuzz::require(std::isfinite(sum.x + sum.y + sum.z));
  }
  const auto again = relief::parse_camera_path(relief::camera_path_text(*path), "path");
  relief::fuzz::require(again && again->keys.size() == path->keys.size());
  return 0;
}

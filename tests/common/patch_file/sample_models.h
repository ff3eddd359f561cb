// Models and scratch folders for the tests of common/.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "common/octahedral.h"
#include "common/patch.h"

namespace relief::test {

/// A folder that is gone after the test.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "relief-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const char* name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// How many files lie in it, temporary ones too.
  [[nodiscard]] std::ptrdiff_t count() const {
    return std::distance(std::filesystem::directory_iterator(path_),
                         std::filesystem::directory_iterator());
  }

 private:
  std::filesystem::path path_;
};

inline std::string slurp(const std::filesystem::path& path) {
  std::string bytes(std::filesystem::file_size(path), '\0');
  std::ifstream(path, std::ios::binary)
      .read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

inline void spill(const std::filesystem::path& path, const std::string& bytes) {
  // Removed first: ext4 writes a file that is truncated and filled again to the disk at once, which
  // makes thousands of small ones slow.
  std::filesystem::remove(path);
  std::ofstream(path, std::ios::binary) << bytes;
}

inline std::vector<std::byte> bytes_of(const std::string& text) {
  std::vector<std::byte> bytes(text.size());
  std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

/// What a patch of bumpy_patch is like.
struct PatchShape {
  std::uint32_t width = 24;
  std::uint32_t height = 17;
  std::uint32_t seed = 1;
  double noise = 0.5;         ///< standard deviation of the heights, in height steps
  bool round = true;          ///< samples in an ellipse with a hole beside its middle
  std::uint32_t normals = 1;  ///< texels per cell, 0: no map
  std::uint32_t colours = 0;  ///< texels per cell, 0: no map
};

/// A smooth bumpy surface at 20 height steps a cell, as a converter makes it; normals are those of
/// the surface without noise.
inline Patch bumpy_patch(const PatchShape& shape) {
  Patch patch;
  std::mt19937 random(shape.seed);
  std::normal_distribution<double> noise(0.0, shape.noise);
  const double angle = 0.3 + shape.seed;
  // A rotation about an axis that is in no plane of the coordinate system.
  const glm::dvec3 z = glm::normalize(glm::dvec3(std::sin(angle), std::cos(angle), 0.7));
  const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0.2, 0.9, -0.4), z));
  patch.axes = glm::dmat3(x, glm::cross(z, x), z);
  patch.origin = {1e6 + shape.seed, -2.5, 5e6};
  patch.spacing = 0.25;
  patch.height_step = 0.0125;
  patch.width = shape.width;
  patch.height = shape.height;
  const double wave = 40.0;  // cells
  const double tau = 2.0 * glm::pi<double>();
  const auto surface = [&](double i, double j) {
    return 4.0 * std::sin(tau * i / wave) * std::cos(tau * j / (0.8 * wave)) + 0.002 * i * j;
  };
  for (std::uint32_t j = 0; j < shape.height; ++j) {
    for (std::uint32_t i = 0; i < shape.width; ++i) {
      const double u = 2.0 * i / std::max(shape.width - 1.0, 1.0) - 1.0;
      const double v = 2.0 * j / std::max(shape.height - 1.0, 1.0) - 1.0;
      const bool inside = u * u + v * v <= 1.0 && std::hypot(u - 0.3, v) > 0.2;
      const double steps = 2000.0 + 20.0 * surface(i, j) + noise(random);
      patch.heights.push_back(!shape.round || inside ? static_cast<std::int32_t>(std::lround(steps))
                                                     : kHole);
    }
  }
  const auto make_map = [&](auto& map, std::uint32_t scale, const auto& texel) {
    if (scale == 0) return;
    map.scale = scale;
    map.width = scale * (shape.width - 1) + 1;
    map.height = scale * (shape.height - 1) + 1;
    for (std::uint32_t b = 0; b < map.height; ++b) {
      for (std::uint32_t a = 0; a < map.width; ++a) {
        map.texels.push_back(texel(double{1} * a / scale, double{1} * b / scale));
      }
    }
  };
  make_map(patch.normals, shape.normals, [&](double i, double j) {
    const double e = 1e-4;
    const glm::dvec3 n(surface(i - e, j) - surface(i + e, j), surface(i, j - e) - surface(i, j + e),
                       2 * e);
    return snorm16_from_unit(glm::normalize(n));
  });
  make_map(patch.colours, shape.colours, [&](double i, double j) {
    const double light = 127.0 + 100.0 * std::sin(0.2 * i + 0.1 * j) + noise(random);
    return glm::u8vec3(std::clamp(light, 0.0, 255.0), std::clamp(0.9 * light + 9, 0.0, 255.0),
                       std::clamp(0.5 * light + i, 0.0, 255.0));
  });
  return patch;
}

/// Gives a model two scalars: whole numbers that vary smoothly, with texels without a value, at two
/// texels a cell; and labels.
inline void add_scalars(PatchModel& model) {
  ScalarInfo number{"intensity", false, -1.5, 0.25, {}};
  ScalarInfo label{"classification", true, 2.0, 1.0, {}};
  for (std::size_t k = 0; k < number.quantiles.size(); ++k) {
    number.quantiles[k] = static_cast<std::uint16_t>(600 * k);
    label.quantiles[k] = static_cast<std::uint16_t>(k / 40);
  }
  model.scalars = {number, label};
  for (Patch& patch : model.patches) {
    for (const std::uint32_t scale : {2U, 1U}) {
      AttributeMap<std::uint16_t> map;
      map.scale = scale;
      map.width = scale * (patch.width - 1) + 1;
      map.height = scale * (patch.height - 1) + 1;
      for (std::uint32_t b = 0; b < map.height; ++b) {
        for (std::uint32_t a = 0; a < map.width; ++a) {
          const bool has_none = scale == 2 && (a * b) % 23 == 22;
          const auto smooth = static_cast<std::uint16_t>(30000 + 800 * a - 500 * b);
          const auto class_code = static_cast<std::uint16_t>(a / 5 % 3);
          map.texels.push_back(has_none ? kNoScalar : (scale == 2 ? smooth : class_code));
        }
      }
      patch.scalars.push_back(std::move(map));
    }
  }
}

/// A model of `patches` patches of various sizes.
inline PatchModel bumpy_model(std::uint32_t patches, std::uint32_t colours = 0) {
  PatchModel model;
  for (std::uint32_t p = 0; p < patches; ++p) {
    PatchShape shape;
    shape.width = 5 + 7 * p % 30;
    shape.height = 4 + 11 * p % 25;
    shape.seed = p + 1;
    shape.colours = colours;
    model.patches.push_back(bumpy_patch(shape));
  }
  model.spacing = 0.25;
  model.bounds.min = {1e6, -10.0, 5e6};
  model.bounds.max = {1e6 + 30, 10.0, 5e6 + 20.0};
  model.bounding_radius = 25.5;
  model.has_colours = colours > 0;
  return model;
}

}  // namespace relief::test

// Textures and textured meshes with known functions on them.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "common/image/image.h"
#include "common/points.h"

namespace relief::test {

/// The unit square in z = 0 as 2 triangles, (u, v) = (x, y).
inline Points unit_square() {
  Points mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// A texture whose channels are value(u, v), 1 - value and 0.25, sampled at the texels' middles.
template <class Function>
Image make_texture(std::uint32_t side, Function&& value) {
  Image image{side, side, {}};
  for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, ChannelType::Float, {}});
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i) {
      const auto v = static_cast<float>(value((i + 0.5) / side, 1.0 - (j + 0.5) / side));
      image.channels[0].values.push_back(v);
      image.channels[1].values.push_back(1.0F - v);
      image.channels[2].values.push_back(0.25F);
    }
  }
  return image;
}

/// A wave of `periods` periods along u, from 0 to 1.
struct Wave {
  double periods = 1.0;
  double operator()(double u, double /*v*/) const {
    return 0.5 + 0.5 * std::sin(2.0 * std::numbers::pi * periods * u);
  }
};

}  // namespace relief::test

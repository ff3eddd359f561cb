// What can be chosen about the engine `volume-truth` alone.
#pragma once

#include <array>
#include <vector>

#include "renderer/engine.h"

namespace relief::volume_truth {

/// What is taken for true.
enum class Truth : std::uint8_t {
  Kernels,  ///< the splatted kernels, attenuated along every ray: what splatting approximates
  Field     ///< the interpolated values, classified and shaded at every place of a ray
};

/// What orders 3D Gaussians.
enum class GaussianOrder : std::uint8_t {
  Ray,    ///< where they are densest on the ray
  Centre  ///< the depths of their centres
};

inline constexpr std::array<Named<Truth>, 2> kTruths{
    {{"kernels", Truth::Kernels}, {"field", Truth::Field}}};
inline constexpr std::array<Named<GaussianOrder>, 2> kGaussianOrders{
    {{"ray", GaussianOrder::Ray}, {"centre", GaussianOrder::Centre}}};

struct TruthSettings {
  Truth truth = Truth::Kernels;
  /// Kernels: the distance of the planes in which they are summed, in standard deviations. Field:
  /// the longest part of a ray that is taken as one, in spacings.
  double step = 0.4;
  GaussianOrder order = GaussianOrder::Ray;
  int side = 1;  ///< rays along a pixel's side; 1: one through its middle, without a filter
};

[[nodiscard]] std::vector<EngineOption> truth_options();
[[nodiscard]] TruthSettings truth_settings(const RenderSettings& settings);

}  // namespace relief::volume_truth

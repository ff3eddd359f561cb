#include "common/volume/transfer_function.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>

namespace relief {
namespace {

/// Where a value lies in a list of stops: between `low` and `low + 1`, at a share of the way.
template <class Stop, class At>
std::pair<std::size_t, double> place_in(const std::vector<Stop>& stops, double value, At at) {
  assert(!stops.empty() && "a function has stops");
  const auto above =
      std::find_if(stops.begin(), stops.end(), [&](const Stop& stop) { return at(stop) > value; });
  if (above == stops.begin()) return {0, 0.0};
  const auto low = static_cast<std::size_t>(above - stops.begin()) - 1;
  if (above == stops.end()) return {low, 0.0};
  return {low, (value - at(stops[low])) / (at(*above) - at(stops[low]))};
}

double opacity_of(const std::vector<OpacityStop>& stops, double at) {
  const auto [low, share] = place_in(stops, at, [](const OpacityStop& stop) { return stop.at; });
  if (share == 0.0) return stops[low].opacity;
  return stops[low].opacity + share * (stops[low + 1].opacity - stops[low].opacity);
}

}  // namespace

glm::vec3 colour_at(const TransferFunction& function, double value) {
  const auto [low, share] =
      place_in(function.colours, value, [](const ColourStop& stop) { return stop.value; });
  if (share == 0.0) return function.colours[low].colour;
  return glm::mix(function.colours[low].colour, function.colours[low + 1].colour,
                  static_cast<float>(share));
}

bool is_transparent_at(const TransferFunction& function, double value) {
  return !(value == value) || opacity_of(function.opacities, value) <= 0.0;
}

double extinction_at(const TransferFunction& function, double value, double gradient_magnitude) {
  if (std::isnan(value)) return 0.0;
  const double opacity = std::clamp(opacity_of(function.opacities, value), 0.0, kMaxOpacity);
  const double extinction = -std::log1p(-opacity) / function.unit_length;
  if (function.gradients.empty() || extinction == 0.0) return extinction;
  return extinction * opacity_of(function.gradients, gradient_magnitude);
}

}  // namespace relief

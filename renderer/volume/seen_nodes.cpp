#include "renderer/volume/seen_nodes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <variant>

#include "renderer/volume/kernels/volume_nodes.h"

namespace relief {
namespace {

/// Values between two others, without these.
struct OpenRange {
  double low;
  double high;
};

/// Where a function is not transparent. A linear piece is opaque between its ends if one of them
/// is; a stop that is transparent lies in neither piece beside it.
std::vector<OpenRange> ranges_seen(const TransferFunction& function) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  const std::vector<OpacityStop>& stops = function.opacities;
  std::vector<OpenRange> seen;
  if (stops.front().opacity > 0.0) seen.push_back({-kEndless, stops.front().at});
  for (std::size_t s = 0; s + 1 < stops.size(); ++s) {
    if (stops[s].opacity > 0.0 || stops[s + 1].opacity > 0.0)
      seen.push_back({stops[s].at, stops[s + 1].at});
  }
  if (stops.back().opacity > 0.0) seen.push_back({stops.back().at, kEndless});
  return seen;
}

/// What is looked for in a row.
struct Sight {
  std::vector<OpenRange> ranges;
  std::vector<double> opaque_stops;  ///< which lie between open ranges
  std::span<const double> isos;

  Sight(std::span<const TransferFunction> functions, std::span<const double> iso_values)
      : isos(iso_values) {
    for (const TransferFunction& function : functions) {
      const std::vector<OpenRange> own = ranges_seen(function);
      ranges.insert(ranges.end(), own.begin(), own.end());
      for (const OpacityStop& stop : function.opacities) {
        if (stop.opacity > 0.0) opaque_stops.push_back(stop.at);
      }
    }
  }

  [[nodiscard]] bool shows(double value) const {
    return std::ranges::any_of(
               ranges,
               [&](const OpenRange& range) { return value > range.low && value < range.high; }) ||
           std::ranges::find(opaque_stops, value) != opaque_stops.end();
  }
  [[nodiscard]] bool has_surface_between(double a, double b) const {
    return std::ranges::any_of(
        isos, [&](double iso) { return std::min(a, b) <= iso && iso <= std::max(a, b); });
  }
};

/// The node of a row that is met first on the way from `first` by `by`; none if none is seen.
std::optional<std::int64_t> first_seen(std::span<const float> row, const Sight& sight,
                                       std::int64_t first, std::int64_t by) {
  const auto count = static_cast<std::int64_t>(row.size());
  const auto at = [&](std::int64_t i) {
    return static_cast<double>(row[static_cast<std::size_t>(i)]);
  };
  for (std::int64_t i = first; i >= 0 && i < count; i += by) {
    if (sight.shows(at(i))) return i;
    const std::int64_t next = i + by;
    if (next >= 0 && next < count && sight.has_surface_between(at(i), at(next))) return i;
  }
  return std::nullopt;
}

}  // namespace

std::vector<glm::dvec3> seen_nodes(const ScalarVolume& volume,
                                   std::span<const TransferFunction> functions,
                                   std::span<const double> isos) {
  if (!std::holds_alternative<RegularGrid>(volume.placement) &&
      !std::holds_alternative<RectilinearGrid>(volume.placement))
    return {};
  const VolumeNodes nodes(volume);
  const Sight sight(functions, isos);
  std::vector<std::vector<glm::dvec3>> planes(volume.size.z);
  tbb::parallel_for(std::uint32_t{0}, volume.size.z, [&](std::uint32_t k) {
    for (std::uint32_t j = 0; j < volume.size.y; ++j) {
      const std::span<const float> row =
          std::span(volume.values).subspan(nodes.index({0, j, k}), volume.size.x);
      const auto low = first_seen(row, sight, 0, 1);
      if (!low) continue;
      const auto high = first_seen(row, sight, std::int64_t{volume.size.x} - 1, -1);
      planes[k].push_back(nodes.position({static_cast<std::uint32_t>(*low), j, k}));
      planes[k].push_back(nodes.position({static_cast<std::uint32_t>(high.value_or(*low)), j, k}));
    }
  });
  std::vector<glm::dvec3> all;
  for (const auto& plane : planes) all.insert(all.end(), plane.begin(), plane.end());
  return all;
}

}  // namespace relief

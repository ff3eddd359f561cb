#include "viewer/choices/volume_choices.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/volume/transfer_function.h"

namespace relief {
namespace {

void extend(NumberChoice& range, const ScalarVolume& volume) {
  for (const float value : volume.values) {
    if (!std::isfinite(value)) continue;
    range.min = std::min(range.min, double{value});
    range.max = std::max(range.max, double{value});
  }
}

}  // namespace

std::optional<NumberChoice> values_of(const LoadedScene& scene) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  NumberChoice range{kInfinite, -kInfinite};
  if (scene.volume) extend(range, *scene.volume);
  if (scene.volumes) {
    for (const VolumePart& part : scene.volumes->list) {
      if (const auto* const volume = std::get_if<ScalarVolume>(&part.what)) extend(range, *volume);
    }
  }
  return range.max > range.min ? std::optional(range) : std::nullopt;
}

std::vector<std::string> offered_transfers(const std::string& in_force) {
  std::vector<std::string> names{"auto"};
  for (const std::string_view preset : transfer_presets()) names.emplace_back(preset);
  if (std::find(names.begin(), names.end(), in_force) == names.end()) names.push_back(in_force);
  return names;
}

}  // namespace relief

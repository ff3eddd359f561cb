// What a window offers of volumes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/scene/choices.h"
#include "loader/scene/loaded_scene.h"

namespace relief {

/// Returns the range of the values of all volumes of a scene; none without volumes, or if all have
/// one value.
[[nodiscard]] std::optional<NumberChoice> values_of(const LoadedScene& scene);

/// Returns the transfer functions to choose from: those that come with Relief, and the file that is
/// in force, if it is one.
[[nodiscard]] std::vector<std::string> offered_transfers(const std::string& in_force);

}  // namespace relief

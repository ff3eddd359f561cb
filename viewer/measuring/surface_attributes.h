// What a patch's maps have at a position, as the renderer looks them up.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "common/patch.h"

namespace relief {

/// Returns the normal at grid coordinates within the patch: unit, patch frame. Of the patch's map,
/// or without one of the slopes of its heights (patch_normals.h); interpolated bilinearly in
/// stereographic coordinates, as shaders/include/maps.glsl does.
[[nodiscard]] glm::dvec3 normal_at(const Patch& patch, glm::dvec2 uv);

/// Returns the stored colour nearest to grid coordinates within the patch; none without a map.
[[nodiscard]] std::optional<glm::u8vec3> stored_colour_at(const Patch& patch, glm::dvec2 uv);

}  // namespace relief

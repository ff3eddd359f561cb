// Where engine `onepass` moves what a view ray meets on a splat: the heights between the samples.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "common/patch.h"

namespace relief {

/// Returns where the ray through `hit` meets the surface between a patch's samples, both in its
/// grid frame: section 3.5 of [Ochotta 2008], as correct() of shaders/include/interpolation.glsl
/// has it, step by step, in double precision. `hit` itself where there is no surface under it;
/// nothing if the ray passes the surface by, so that no fragment is drawn. `ray`: of any length.
[[nodiscard]] std::optional<glm::dvec3> corrected_hit(const Patch& patch, glm::dvec3 hit,
                                                      glm::dvec3 ray);

}  // namespace relief

// The names of feature bits, as shaders/include/shared.h defines them.
#pragma once

#include <string>
#include <vector>

#include "renderer/gl/shader/features.h"

namespace relief {

/// The names of these bits in the order of the bits: RELIEF_FEATURE_OUT_NORMAL is "out_normal";
/// and last the number of lights, "lights 3".
[[nodiscard]] std::vector<std::string> feature_names(Features features);

}  // namespace relief

// Checks the values of a patch file after reading and before writing.
#pragma once

#include <string>

#include "common/patch_file/patch_file.h"

namespace relief {

/// Returns what is wrong with a patch's frame or size, as a clause; empty if nothing is.
[[nodiscard]] std::string find_fault(const PatchSummary& patch);

/// Returns what is wrong with a model's spacing, bounds or radius, as a clause; empty if nothing
/// is. `bounds` may be empty.
[[nodiscard]] std::string find_fault(double spacing, const Bounds& bounds, double bounding_radius);

}  // namespace relief

// What a viewer needs of a model before it reads a patch, beside the header (docs/patch-file.md,
// "Model block").
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/bounds.h"
#include "common/error.h"
#include "common/scalar.h"
#include "common/stance.h"

namespace relief {

/// The most bytes that a block may have: readers take it whole.
inline constexpr std::size_t kMaxModelBlock = std::size_t{1} << 20U;

struct ModelBlock {
  std::vector<glm::dvec3> extremes;  ///< as PatchModel::extremes
  Stance stance;
  std::vector<ScalarInfo> scalars = {};  ///< as PatchModel::scalars
};

/// Returns the bytes of a block; none if it says nothing that a reader would not assume. `bounds`:
/// the header's.
[[nodiscard]] std::vector<std::byte> write_model_block(const ModelBlock& block,
                                                       const Bounds& bounds);

/// Reads and checks a block. Skips entries of unknown types. Errors are sentences that begin with
/// `name`.
Result<ModelBlock> parse_model_block(std::span<const std::byte> bytes, const Bounds& bounds,
                                     const std::string& name);

}  // namespace relief

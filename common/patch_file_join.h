// Several patch files become one, without decoding what is in them.
#pragma once

#include <filesystem>
#include <vector>

#include "common/patch_file.h"

namespace relief {

/// What the joined model is as a whole; its patches are the parts'.
struct JoinedModel {
  double spacing = 0.0;  ///< as PatchModel
  Bounds bounds;
  double bounding_radius = 0.0;
};

/// Writes a file with the patches of all parts, in their order; written beside and renamed. Parts
/// must be of one version, and of the same bounds and spacing, relative to which places are kept;
/// then each patch reads as it did from its part. Of the parts little more than the indexes is in
/// memory. Fails with one sentence.
Status join_patch_files(const std::filesystem::path& path,
                        const std::vector<std::filesystem::path>& parts, const JoinedModel& model);

}  // namespace relief

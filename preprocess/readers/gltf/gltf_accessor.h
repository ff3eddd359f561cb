// Numbers out of a glTF file's buffers. Not a public header: it needs tinygltf.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/error.h"

// Pictures are decoded by common/image_io.h, files read by common/file.h.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

namespace relief {

/// The bytes of a buffer view, or a clause that says why there are none. No index and no length of
/// the file is trusted.
Result<std::span<const std::byte>> view_bytes(const tinygltf::Model& model, int view);

/// All numbers of an accessor of `components` components (1 to 4) each, as doubles; those of
/// normalised integers in [0, 1] or [-1, 1]. Errors are clauses.
Result<std::vector<double>> read_accessor(const tinygltf::Model& model, int accessor,
                                          int components);

}  // namespace relief

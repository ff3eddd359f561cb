// Reads numbers from the buffers of a glTF file. Not a public header: it needs tinygltf.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/error.h"

// common/image/image_io.h decodes images, common/io/file.h reads files.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

namespace relief {

/// Returns the bytes of a buffer view. Indices and lengths are not trusted. Errors are clauses.
Result<std::span<const std::byte>> view_bytes(const tinygltf::Model& model, int view);

/// Returns all numbers of an accessor of `components` components (1 to 4) as doubles; normalised
/// integers in [0, 1] or [-1, 1]. Errors are clauses.
Result<std::vector<double>> read_accessor(const tinygltf::Model& model, int accessor,
                                          int components);

}  // namespace relief

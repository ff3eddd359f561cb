// Parses glTF files with tinygltf. Not a public header: it needs tinygltf.
#pragma once

#include "common/error.h"
#include "preprocess/readers/gltf/gltf_accessor.h"
#include "preprocess/readers/source.h"

namespace relief {

/// Parses a glTF file, as JSON or binary, and reads its buffers; embedded, or files beside it.
/// Images stay undecoded. The result is not trusted: indices may be invalid. Errors begin with the
/// file's name.
Result<tinygltf::Model> parse_gltf(const Source& source);

}  // namespace relief

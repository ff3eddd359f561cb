// The mask of the nodes of a patch that are samples, in codec 2 of the patch file
// (docs/patch-file.md, "Codec 2").
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/patch_file/compact/rans.h"

namespace relief {

/// Codes a row-major mask of 0 and 1.
void put_mask(RansEncoder& out, std::span<const std::uint8_t> mask, std::size_t width);

/// Inverse of put_mask. Damaged bytes may give any mask; the decoder's is_sound() is then false.
[[nodiscard]] std::vector<std::uint8_t> take_mask(RansDecoder& in, std::size_t width,
                                                  std::size_t height);

}  // namespace relief

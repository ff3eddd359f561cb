// Masks of samples as run lengths: part of codec 1 of the patch file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/io/bytes.h"
#include "common/patch_file/fast/zstd_contexts.h"

namespace relief {

/// Appends a row-major mask of ones and zeros. A node is coded as its difference to the node north
/// of it, so that only slanted borders cost bytes.
void append_mask(std::vector<std::byte>& out, std::span<const std::uint8_t> mask, std::size_t width,
                 ZstdContexts& zstd);

/// Inverse of append_mask. Safe on hostile bytes; allocates at most 2 bytes a node.
Result<std::vector<std::uint8_t>> take_mask(ByteReader& in, std::size_t width, std::size_t height,
                                            ZstdContexts& zstd);

}  // namespace relief

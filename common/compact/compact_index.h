// The index of version 2 of the patch file: about 40 bytes a patch instead of 192
// (docs/patch-file.md, "Version 2").
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/patch_file_layout.h"

namespace relief {

/// The least that the index says of a patch, in bytes.
inline constexpr std::size_t kLeastCompactRecord = 28;

/// Steps in which version 2 keeps places: a power of two, at most a 16th of any patch's height
/// step, so that rounding moves no sample by more than 0.06 height steps. 1 for a model without
/// patches.
[[nodiscard]] double placement_step(std::span<const PatchSummary> patches);

/// What places are relative to: the model's least corner.
[[nodiscard]] glm::dvec3 index_base(const Bounds& bounds);

/// What is left of a patch's place, axes and normal cone in version 2. `base` is
/// index_base. The cone holds what it held before.
[[nodiscard]] PatchSummary rounded_summary(const PatchSummary& patch, const glm::dvec3& base,
                                           double step);

/// Of an index whose summaries are rounded; chunks lie one after another behind the header, each
/// patch's heights first.
[[nodiscard]] std::vector<std::byte> write_compact_index(const FileIndex& index,
                                                         const FileHeader& header);

/// Reads and checks the index; its checksum was found right. Errors are whole sentences that start
/// with `name`.
Result<FileIndex> parse_compact_index(std::span<const std::byte> bytes, const FileHeader& header,
                                      const std::string& name);

}  // namespace relief

// The table of a patch file's scalars: the entry SCLS of its model block (docs/patch-file.md).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/scalar.h"

namespace relief {

/// Returns what is wrong with a model's scalars, as a clause; empty if nothing is.
[[nodiscard]] std::string find_fault(std::span<const ScalarInfo> scalars);

[[nodiscard]] std::vector<std::byte> write_scalar_table(std::span<const ScalarInfo> scalars);

/// Inverse of write_scalar_table. Safe on hostile bytes; errors are clauses.
Result<std::vector<ScalarInfo>> parse_scalar_table(std::span<const std::byte> bytes);

}  // namespace relief

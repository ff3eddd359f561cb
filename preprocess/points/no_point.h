// The index that stands for no point.
#pragma once

#include <cstdint>

namespace relief {

/// Points can be indexed with 32 bits; the largest index stands for "no such point".
inline constexpr std::uint32_t kNoPoint = UINT32_MAX;

}  // namespace relief

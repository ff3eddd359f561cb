#pragma once

namespace relief {
inline constexpr const char* kVersion = "0.1.0";
}  // namespace relief

// Where OpenGL comes from.
#pragma once

#include <cstdint>

namespace relief {

/// Automatic tries EGL first, then OSMesa if EGL is missing or has no display.
enum class GlPlatform : std::uint8_t { Automatic, Egl, Osmesa };

}  // namespace relief

// What rendering an image gives.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "renderer/explanation/explanation.h"
#include "renderer/explanation/pass_time.h"

namespace relief {

struct RenderResult {
  Image image;
  std::string renderer;  ///< OpenGL's own name, or the ray tracer's; "CPU" for ewa
  /// Wall-clock time of a finished frame, without readback: the median of RenderSettings::frames,
  /// or without these of the only one, in which OpenGL may still be compiling shaders.
  double frame_ms = 0.0;
  std::optional<double> gpu_ms;      ///< likewise by OpenGL's timer, if it has one
  std::uint64_t covered_pixels = 0;  ///< pixels with coverage above 0
  /// Fragments shaded by the model's passes (the cost that [Ochotta 2008] counts), if they were
  /// counted; for ewa contributions of kernels to pixels.
  std::optional<std::uint64_t> fragments;
  /// The coarser set of points that was drawn, 0: all of them; none without
  /// EwaSettings::time_budget_ms.
  std::optional<std::uint32_t> level;
  std::optional<Explanation> explanation;  ///< if settings asked for it, of the frame
  std::vector<PassTime> passes;            ///< if settings asked for them: medians of frames
};

}  // namespace relief

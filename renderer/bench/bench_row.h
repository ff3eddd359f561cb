// A row of a bench: what is drawn, and what was measured of it.
#pragma once

#include <cstdint>
#include <optional>

#include "renderer/model.h"
#include "renderer/settings.h"

namespace relief {

/// One way to draw: what, and how. The engine draws the first of its forms that the model has.
struct BenchMethod {
  RenderModel model;
  RenderSettings settings;
};

/// Rows on the CPU, whose frames may take seconds, are timed in fewer rounds: as many as the frames
/// of the slowest of them fit into kCpuSeconds, at most kMostCpuFrames, and at least one.
inline constexpr double kCpuSeconds = 10.0;
inline constexpr int kMostCpuFrames = 5;

/// Medians over the timed rounds.
struct BenchTime {
  int frames = 0;                ///< of which this is the median
  double frame_ms = 0.0;         ///< wall clock, from the first command until all have finished
  std::optional<double> gpu_ms;  ///< OpenGL's timer, if it has one
};

struct BenchRow {
  BenchTime time;
  std::uint64_t covered_pixels = 0;
  std::optional<std::uint64_t> fragments;    ///< as RenderResult::fragments
  std::optional<std::uint64_t> gpu_bytes;    ///< of all buffers and textures that a frame binds
  std::optional<std::uint64_t> model_bytes;  ///< of those that no framebuffer draws into
};

}  // namespace relief

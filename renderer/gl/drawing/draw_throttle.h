// Bounds what OpenGL on the CPU keeps of triangles that it has not drawn yet.
#pragma once

#include <cstdint>

#include "renderer/gl/functions.h"

namespace relief {

/// Triangles between two fences. llvmpipe keeps some 450 bytes of each triangle that it has set up,
/// until it is rasterised, and sets up as many as it is given: a view of 60 million points had
/// 120 MB of them. With two fences' worth in flight the threads that rasterise have work from the
/// beginning: the Dragon took 0.83 of the time (640x400, median of 4 runs in turns; 0.91 with
/// 131072).
inline constexpr std::uint64_t kTrianglesPerFence = 32768;

/// Waits, while much is drawn, until what was drawn before is done: on the CPU; a GPU keeps no
/// triangles, and nothing waits there.
class DrawThrottle {
 public:
  explicit DrawThrottle(const Gl& gl);
  ~DrawThrottle();
  DrawThrottle(const DrawThrottle&) = delete;
  DrawThrottle& operator=(const DrawThrottle&) = delete;

  /// To be called after each draw, with its triangles (of both sides, seen or not).
  void drew(std::uint64_t triangles);

 private:
  const Gl& gl_;
  bool is_needed_;
  std::uint64_t triangles_ = 0;  ///< since the last fence
  GLsync before_ = nullptr;      ///< the last fence
};

}  // namespace relief

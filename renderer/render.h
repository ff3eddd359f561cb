// From patches to a picture: one frame, headless.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/camera.h"
#include "common/error.h"
#include "common/image.h"
#include "common/patch.h"

namespace relief {

enum class Primitive : std::uint8_t { Sprite, Quad };
enum class Interpolation : std::uint8_t { Direct, Corrected };
enum class Material : std::uint8_t { Unlit, Lit, Mirror };
/// Where OpenGL comes from. Automatic: EGL, and OSMesa where EGL is missing or has no display.
enum class GlPlatform : std::uint8_t { Automatic, Egl, Osmesa };

/// Which outputs a picture has. Colour and coverage are always there; nothing is allocated, written
/// or read back for an output that is off.
struct Outputs {
  bool normal = false;
  bool depth = false;
  bool uv = false;
  bool patch_id = false;
};

struct RenderSettings {
  std::uint32_t width = 1280;
  std::uint32_t height = 1024;
  Camera camera;
  Primitive primitive = Primitive::Quad;
  Interpolation interpolation = Interpolation::Corrected;
  Material material = Material::Lit;
  std::filesystem::path environment;  ///< equirectangular EXR or HDR; for Mirror and as backdrop
  std::optional<glm::vec3> background{
      {0, 0, 0}};  ///< linear RGB; none: alpha 0 where nothing is seen
  Outputs outputs;
  GlPlatform platform = GlPlatform::Automatic;
  int frames = 3;      ///< timed frames after one warm-up; the median counts
  bool debug = false;  ///< OpenGL debug context; a high-severity message is an error
};

struct RenderResult {
  Image image;
  std::string renderer;          ///< OpenGL's own name
  double frame_ms = 0.0;         ///< median of wall-clock frame times, finished, without readback
  std::optional<double> gpu_ms;  ///< median of OpenGL's timer, if it has one
  std::uint64_t covered_pixels = 0;        ///< pixels with coverage above 0
  std::optional<std::uint64_t> fragments;  ///< fragments shaded by the model's pass (paper 001's
                                           ///< cost), if OpenGL counts them
};

/// Renders a model with the engine `onepass` (paper 001, sections 3.2 to 3.6).
/// Fails with one sentence: no OpenGL, an unreadable environment, a picture larger than OpenGL
/// allows.
Result<RenderResult> render(const PatchModel& model, const RenderSettings& settings);

}  // namespace relief

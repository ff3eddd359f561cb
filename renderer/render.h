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
#include "common/progress.h"
#include "renderer/engines/ewa/settings.h"
#include "renderer/engines/raytrace/settings.h"
#include "renderer/splat_cloud.h"
#include "renderer/triangle_mesh.h"

namespace relief {

/// A way to turn a model into pixels. Onepass: paper 001, on OpenGL. Ewa: paper 000, the reference.
/// Raytrace: the truth.
enum class EngineKind : std::uint8_t { Onepass, Ewa, Raytrace };
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
  EngineKind engine = EngineKind::Onepass;
  std::uint32_t width = 1280;
  std::uint32_t height = 1024;
  Camera camera;
  Primitive primitive = Primitive::Quad;
  Interpolation interpolation = Interpolation::Corrected;
  Material material = Material::Lit;
  std::vector<Material> materials;    ///< by SplatCloud::materials; empty: `material` for all
  std::filesystem::path environment;  ///< equirectangular EXR or HDR; for Mirror and as backdrop
  std::optional<glm::vec3> background{
      {0, 0, 0}};  ///< linear RGB; none: alpha 0 where nothing is seen
  Outputs outputs;
  EwaSettings ewa;
  RaytraceSettings raytrace;
  GlPlatform platform = GlPlatform::Automatic;
  int frames = 3;      ///< timed frames after one warm-up; the median counts
  bool debug = false;  ///< OpenGL debug context; a high-severity message is an error
};

struct RenderResult {
  Image image;
  std::string renderer;          ///< OpenGL's own name, or the ray tracer's; "CPU" for ewa
  double frame_ms = 0.0;         ///< median of wall-clock frame times, finished, without readback
  std::optional<double> gpu_ms;  ///< median of OpenGL's timer, if it has one
  std::uint64_t covered_pixels = 0;        ///< pixels with coverage above 0
  std::optional<std::uint64_t> fragments;  ///< fragments shaded by the model's pass (paper 001's
                                           ///< cost), if OpenGL counts them; for ewa contributions
                                           ///< of kernels to pixels
  std::optional<std::uint32_t> level;  ///< coarser set of points that was drawn, 0: all of them;
                                       ///< nothing without EwaSettings::time_budget_ms
};

/// Renders patches with any engine: `onepass` draws them (paper 001, sections 3.2 to 3.6), `ewa`
/// splats their samples, `raytrace` hits their triangulation (each cell halved along the same
/// diagonal). Fails with one sentence: no OpenGL, an unreadable environment, a picture larger than
/// OpenGL allows, an interruption by the user.
Result<RenderResult> render(const PatchModel& model, const RenderSettings& settings,
                            Progress& progress);

/// Renders a mesh with the engine `raytrace`, whatever `settings.engine` says.
Result<RenderResult> render(const TriangleMesh& mesh, const RenderSettings& settings,
                            Progress& progress);

/// Renders points with the engine `ewa`, whatever `settings.engine` says.
Result<RenderResult> render(const SplatCloud& splats, const RenderSettings& settings,
                            Progress& progress);

}  // namespace relief

// From patches to a picture: one frame, headless.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/image/image.h"
#include "common/patch.h"
#include "common/progress.h"
#include "common/scene/camera.h"
#include "common/scene/choices.h"
#include "common/scene/light.h"
#include "common/scene/material.h"
#include "renderer/engines/ewa/settings.h"
#include "renderer/engines/multipass/settings.h"
#include "renderer/engines/raytrace/settings.h"
#include "renderer/frame/explanation.h"
#include "renderer/geometry/splat_cloud.h"
#include "renderer/geometry/triangle_mesh.h"

namespace relief {

/// Where OpenGL comes from. Automatic: EGL, and OSMesa where EGL is missing or has no display.
enum class GlPlatform : std::uint8_t { Automatic, Egl, Osmesa };

struct RenderSettings {
  EngineKind engine = EngineKind::Onepass;
  std::uint32_t width = 1280;
  std::uint32_t height = 1024;
  Camera camera;
  Primitive primitive = Primitive::Cell;
  Interpolation interpolation = Interpolation::Corrected;
  Sides sides = Sides::Both;  ///< of the engines on OpenGL
  Material material = Material::Lit;
  MaterialConstants constants;  ///< of `material`
  /// By Patch::material and its like in meshes and clouds; empty: `material` for all. At most
  /// kMaxMaterials, with kMaxRoughnesses roughnesses above 0.
  std::vector<MaterialSettings> materials;
  Lights lights;                      ///< for Lit
  std::filesystem::path environment;  ///< as load_environment takes it; for what reflects and as
                                      ///< backdrop
  std::optional<glm::vec3> background{
      {0, 0, 0}};  ///< linear RGB; none: alpha 0 where nothing is seen
  Outputs outputs;
  std::optional<double> pixels_per_sample;  ///< of `onepass`: pixels_per_sample_of() says
  /// Of the engines on OpenGL: samples a pixel, at least 1; they are a square grid, of at least as
  /// many. With several, colour and coverage are means over the pixel, while normal, depth, UV and
  /// patch id are those of its middle, as RaytraceSettings says.
  int samples = 1;
  MultipassSettings multipass;
  EwaSettings ewa;
  RaytraceSettings raytrace;
  GlPlatform platform = GlPlatform::Automatic;
  int frames = 3;      ///< timed frames; the median counts. on OpenGL one more is drawn before them
  bool debug = false;  ///< OpenGL debug context; a high-severity message is an error
  bool explain = false;  ///< RenderResult::explanation, of the engines on OpenGL; such a picture
                         ///< has nothing beside it that counts fragments
};

/// What a picture of cells has unasked. The Dragon at 1280x1024, lit, against a ray-traced truth: 4
/// pixels 38.5 dB in 0.63 of the CPU time of the finest level, which has 39.4 dB; 8 pixels 36.0 dB
/// in 0.33.
inline constexpr double kPixelsPerSampleOfCells = 4.0;

/// Each patch is drawn at its coarsest level whose samples are seen at most this far apart, in
/// pixels; 0: the finest. Sprites and quads, the ways of paper 001, have that unasked.
[[nodiscard]] inline double pixels_per_sample_of(const RenderSettings& settings) {
  if (settings.engine != EngineKind::Onepass) return 0.0;
  const bool cells = settings.primitive == Primitive::Cell;
  return settings.pixels_per_sample.value_or(cells ? kPixelsPerSampleOfCells : 0.0);
}

struct RenderResult {
  Image image;
  std::string renderer;          ///< OpenGL's own name, or the ray tracer's; "CPU" for ewa
  double frame_ms = 0.0;         ///< median of wall-clock frame times, finished, without readback
  std::optional<double> gpu_ms;  ///< median of OpenGL's timer, if it has one
  std::uint64_t covered_pixels = 0;        ///< pixels with coverage above 0
  std::optional<std::uint64_t> fragments;  ///< fragments shaded by the model's passes (paper 001's
                                           ///< cost), if OpenGL counts them; for ewa contributions
                                           ///< of kernels to pixels
  std::optional<std::uint32_t> level;  ///< coarser set of points that was drawn, 0: all of them;
                                       ///< nothing without EwaSettings::time_budget_ms
  std::optional<Explanation> explanation;  ///< if settings asked for it, of a timed frame
};

/// A model in the forms that engines draw; they outlive the rendering. `onepass` and `multipass`
/// need the patches. `raytrace` follows rays to the mesh, or without one to the triangulation of
/// the patches (each cell halved along the same diagonal). `ewa` splats the points, or without any
/// the patches' samples.
struct RenderModel {
  const PatchModel* patches = nullptr;
  const TriangleMesh* mesh = nullptr;
  const SplatCloud* splats = nullptr;
};

/// Renders patches with any engine: `onepass` draws them (paper 001, sections 3.2 to 3.6). Fails
/// with one sentence: no OpenGL, an unreadable environment, a picture larger than OpenGL allows, an
/// interruption by the user.
Result<RenderResult> render(const PatchModel& model, const RenderSettings& settings,
                            Progress& progress);

/// Takes a picture as soon as it is done; `view` is its place in the list. An error ends the
/// rendering and comes out of it. Must not render itself: OpenGL has one context at a time.
using PictureSink = std::function<Status(std::size_t view, RenderResult picture)>;

/// Renders several views of one model, one engine after the other and within each in the list's
/// order. What does not depend on the view (an OpenGL context, the model on the GPU, environments)
/// is made once for each engine; each picture is the same as if it were the only
/// one. All views have the same `platform`, `debug` and `explain`. Fails as render() does.
Status render_views(const RenderModel& model, std::span<const RenderSettings> views,
                    const PictureSink& sink, Progress& progress);

/// Renders a mesh with the engine `raytrace`, whatever `settings.engine` says.
Result<RenderResult> render(const TriangleMesh& mesh, const RenderSettings& settings,
                            Progress& progress);

/// Renders points with the engine `ewa`, whatever `settings.engine` says.
Result<RenderResult> render(const SplatCloud& splats, const RenderSettings& settings,
                            Progress& progress);

}  // namespace relief

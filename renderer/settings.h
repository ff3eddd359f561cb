// What an image is made with: camera, engine, materials, outputs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/camera.h"
#include "common/scene/choices.h"
#include "common/scene/light.h"
#include "common/scene/material.h"
#include "common/scene/option.h"
#include "common/stance.h"
#include "renderer/clip/settings.h"
#include "renderer/engines/ewa/settings.h"
#include "renderer/engines/multipass/settings.h"
#include "renderer/engines/raytrace/settings.h"
#include "renderer/gl/context/platform.h"
#include "renderer/surfels/settings.h"
#include "renderer/volume/settings.h"

namespace relief {

struct RenderSettings {
  std::string engine = "onepass";  ///< a name from the registry (renderer/engine_registry.h)
  std::uint32_t width = 1280;
  std::uint32_t height = 1024;
  Camera camera;
  Primitive primitive = Primitive::Cell;
  Interpolation interpolation = Interpolation::Corrected;
  CullMode cull = CullMode::Safe;  ///< of the engines on OpenGL
  Material material = Material::Lit;
  MaterialConstants constants;  ///< of `material`
  /// By Patch::material and its like in meshes and clouds; empty: `material` for all. At most
  /// kMaxMaterials, with kMaxRoughnesses roughnesses above 0.
  std::vector<MaterialSettings> materials;
  Lights lights;                      ///< for Lit
  std::filesystem::path environment;  ///< as load_environment takes it; for what reflects and as
                                      ///< backdrop
  /// How the environment stands, and by how much it is turned about its up direction
  /// (renderer/shading/environment/standing_cube.h).
  Stance environment_stance;
  double environment_rotation_degrees = 0.0;
  /// Linear RGB; none: alpha 0 where nothing is seen.
  std::optional<glm::vec3> background{{0, 0, 0}};
  bool shows_environment = true;  ///< as backdrop, if there is a background for it to be
  double eye_dome = 0.0;          ///< strength of eye-dome lighting (renderer/eye_dome.h); 0: none
  Outputs outputs;
  std::optional<double> pixels_per_sample;  ///< of `onepass`: see pixels_per_sample_of
  /// Of `onepass`: models are drawn from afar (renderer/geometry/proxy/proxy.h) up to so many times
  /// the size, at least 1: quicker and coarser pictures while a camera moves.
  double afar_factor = 1.0;
  /// Of the engines on OpenGL: samples a pixel, at least 1; they are a square grid of at least that
  /// many. With several, colour and coverage are means over the pixel, while normal, depth, UV and
  /// patch id are those of its middle, as RaytraceSettings says.
  int samples = 1;
  MultipassSettings multipass;
  EwaSettings ewa;
  RaytraceSettings raytrace;
  SurfelSettings surfel;
  ClipSettings clip;  ///< of the engines that splat surfaces
  VolumeSettings volume;
  /// By VolumePart::settings: what is said there of the values' looks (transfer, iso, iso_opacity,
  /// kernel_sigma, material, Gaussians' degree) holds for that part. Empty: `volume` for all.
  std::vector<VolumeSettings> volumes;
  /// Values of engine options that have no member here: an engine's own (renderer/engine.h).
  OptionValues options;
  GlPlatform platform = GlPlatform::Automatic;
  /// Frames to time, whose median is RenderResult::frame_ms; on OpenGL they follow the one that
  /// draws the image. 0: only that is drawn, and timed.
  int frames = 0;
  bool count_fragments = false;  ///< RenderResult::fragments, in one more frame on OpenGL
  bool debug = false;            ///< OpenGL debug context; a high-severity message is an error
  bool explain = false;  ///< RenderResult::explanation, of the engines on OpenGL; fragments of
                         ///< such an image are not counted
  /// RenderResult::passes, of the engines that explain: frames in which passes are timed.
  int pass_frames = 0;
  /// Explanation::costs, with `explain` and of the engines that draw patches with OpenGL: how often
  /// the image is drawn with and without each feature. 0: not at all.
  int cost_turns = 0;
};

/// Whether the environment is seen behind the model.
[[nodiscard]] inline bool has_backdrop(const RenderSettings& settings) {
  return !settings.environment.empty() && settings.background && settings.shows_environment;
}

/// The default for cells: levels are off the finest by at most 1/32 of a pixel. The Dragon at
/// 1280x1024, lit, has 47.8 dB against the ray-traced scan, as at the finest level.
inline constexpr double kPixelsPerSampleOfCells = 4.0;

/// Each patch is drawn at its coarsest level whose samples are seen at most this far apart, in
/// pixels, and which is off the finest by at most kMostLevelError of that
/// (geometry/cells/levels.h); 0: the finest, the default for sprites and quads, the methods of
/// [Ochotta 2008].
[[nodiscard]] inline double pixels_per_sample_of(const RenderSettings& settings) {
  if (settings.engine != "onepass") return 0.0;  // the only engine with levels of detail
  const bool cells = settings.primitive == Primitive::Cell;
  return settings.pixels_per_sample.value_or(cells ? kPixelsPerSampleOfCells : 0.0);
}

}  // namespace relief

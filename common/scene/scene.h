// A scene: models in their places, and the views that pictures are made of. The file format:
// docs/scene.md.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/scene/camera.h"
#include "common/scene/choices.h"
#include "common/scene/light.h"
#include "common/scene/material.h"
#include "common/transform.h"

namespace relief {

/// What lies behind the model.
struct Background {
  std::optional<glm::vec3> colour;  ///< linear RGB; none: alpha 0 where nothing is seen
};

/// What someone (the command line, a scene, one of its views) says about a picture. Each member is
/// an option of `relief render`; what is not said is empty.
struct SceneSettings : MaterialWords {
  std::optional<ImageSize> size;
  std::optional<Orbit> orbit;
  std::optional<glm::dvec3> eye;  ///< world units, as target; not beside an orbit
  std::optional<glm::dvec3> target;
  std::optional<glm::dvec3> up;
  std::optional<double> fov_degrees;  ///< not beside `orthographic`
  std::optional<OrthographicSize> orthographic;
  std::optional<std::string> engine;  ///< by name; the renderer knows which there are
  std::optional<Primitive> primitive;
  std::optional<Interpolation> interpolation;
  std::optional<CullMode> cull;              ///< onepass, multipass
  std::optional<std::vector<Light>> lights;  ///< not empty
  std::optional<glm::vec3> ambient;          ///< linear
  std::optional<std::filesystem::path> environment;
  std::optional<Background> background;
  std::optional<double> exposure;  ///< stops, of a PNG
  std::optional<Outputs> outputs;
  std::optional<double> pixels_per_sample;  ///< onepass
  std::optional<double> radius_factor;      ///< multipass
  std::optional<int> samples;               ///< onepass, multipass, raytrace
  std::optional<EwaFilter> filter;
  std::optional<double> cutoff;
  std::optional<int> layers;
  std::optional<double> coverage_threshold;
  std::optional<double> time_budget_ms;
};

struct SceneModel {
  std::filesystem::path file;
  Transform transform;
  MaterialWords material;         ///< counts more than what views say
  std::optional<bool> is_closed;  ///< instead of what is known of the file
};

struct SceneView {
  std::string name;  ///< letters, digits, - _ . and no dot first: good in a file name
  SceneSettings settings;
};

/// At least one model and one view; the views' names differ.
struct Scene {
  std::vector<SceneModel> models;
  SceneSettings settings;  ///< of all views, unless a view says otherwise
  std::vector<SceneView> views;
};

/// The most that a scene file may have: bounds what a hostile one can ask for.
inline constexpr std::size_t kMaxSceneBytes = std::size_t{1} << 20U;
inline constexpr std::size_t kMaxSceneModels = 1000;
inline constexpr std::size_t kMaxSceneViews = 10000;
/// Coordinates in a scene file, world units: beyond it doubles are farther apart than 1e-4.
inline constexpr double kMaxSceneCoordinate = 1e12;

/// Reads a scene file. Trusts nothing: unknown or repeated keys, wrong types, numbers out of range,
/// and what is deeper or larger than a scene can be are told in one sentence with the place in the
/// file. Paths in it are relative to its folder; no file but itself is opened.
Result<Scene> read_scene(const std::filesystem::path& path);

/// What the models say about their materials, each once, in the models' order: at most
/// kMaxMaterials.
[[nodiscard]] std::vector<MaterialWords> materials_said(const std::vector<SceneModel>& models);

/// What `over` says, and where it says nothing, what `base` says. An orbit and an eye displace each
/// other, and so do a field of view and an orthographic picture.
[[nodiscard]] SceneSettings overlay(SceneSettings base, const SceneSettings& over);

/// The camera of a picture of the model. An eye looks at the middle of the model's bounds unless a
/// target is given; without an eye the camera is on an orbit about it. An orthographic one without
/// a height sees the model's bounding sphere just whole. Fails, with a clause, if the eye is where
/// it looks.
Result<Camera> camera_for(const SceneSettings& settings, const PatchModel& model);

}  // namespace relief

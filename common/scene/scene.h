// A scene: models in their positions, and the views to draw of them. The file format:
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
#include "common/scene/option.h"
#include "common/transform.h"

namespace relief {

/// What lies behind the model.
struct Background {
  std::optional<glm::vec3> colour;  ///< linear RGB; none: alpha 0 where nothing is seen
};

/// What the command line, a scene or one of its views sets for an image. Each member is an option
/// of `relief render`; what is not set is empty.
struct SceneSettings : MaterialWords {
  std::optional<ImageSize> size;
  std::optional<Orbit> orbit;
  std::optional<glm::dvec3> eye;  ///< world units, as target; not beside an orbit
  std::optional<glm::dvec3> target;
  std::optional<glm::dvec3> up;
  std::optional<double> fov_degrees;  ///< not beside `orthographic`
  std::optional<OrthographicSize> orthographic;
  std::optional<std::string> engine;         ///< by name; the renderer knows which there are
  std::optional<std::vector<Light>> lights;  ///< not empty
  std::optional<glm::vec3> ambient;          ///< linear
  std::optional<std::filesystem::path> environment;
  std::optional<Background> background;
  std::optional<double> exposure;  ///< stops, of a PNG
  std::optional<Outputs> outputs;
  OptionValues options;  ///< of engines, by key; those of other engines than `engine` do not count
};

struct SceneModel {
  std::filesystem::path file;
  Transform transform;
  MaterialWords material;         ///< overrides that of views
  std::optional<bool> is_closed;  ///< instead of what is known of the file
};

struct SceneView {
  std::string name;  ///< letters, digits, - _ . and no dot first: good in a file name
  SceneSettings settings;
};

/// At least one model and one view; the views' names differ.
struct Scene {
  std::vector<SceneModel> models;
  SceneSettings settings;  ///< of all views, unless a view overrides them
  std::vector<SceneView> views;
};

/// The most that a scene file may have: bounds what a hostile one can ask for.
inline constexpr std::size_t kMaxSceneBytes = std::size_t{1} << 20U;
inline constexpr std::size_t kMaxSceneModels = 1000;
inline constexpr std::size_t kMaxSceneViews = 10000;
/// Coordinates in a scene file, world units: beyond it doubles are farther apart than 1e-4.
inline constexpr double kMaxSceneCoordinate = 1e12;

/// Reads a scene file. `engines`: what it may name. Trusts nothing: fails, with one sentence that
/// names the position in the file, at unknown or repeated keys, wrong types, numbers out of range,
/// and nesting or sizes beyond those of a scene. Paths in it are relative to its folder; no other
/// file is opened.
Result<Scene> read_scene(const std::filesystem::path& path, const EngineKeys& engines);

/// The different materials that the models set, in the models' order: at most kMaxMaterials.
[[nodiscard]] std::vector<MaterialWords> materials_said(const std::vector<SceneModel>& models);

/// The settings of `base`, overridden by those that `over` has. An orbit and an eye replace each
/// other, and so do a field of view and an orthographic image.
[[nodiscard]] SceneSettings overlay(SceneSettings base, const SceneSettings& over);

/// The camera of an image of the model. An eye looks at the middle of the model's bounds unless a
/// target is given; without an eye the camera is on an orbit about it. An orthographic one without
/// a height sees the model's bounding sphere just whole. Fails, with a clause, if the eye is where
/// it looks.
Result<Camera> camera_for(const SceneSettings& settings, const PatchModel& model);

}  // namespace relief

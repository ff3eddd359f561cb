// A scene: models in their positions, and the views to draw of them. The file format:
// docs/scene.md.
#pragma once

#include <array>
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

/// The background of an image.
struct Background {
  std::optional<glm::vec3> colour;  ///< linear RGB; none: alpha 0 where there is no surface
};

/// The settings of an image that the command line, a scene or a view makes. Each member is an
/// option of `relief render`, empty if it is not set.
struct SceneSettings : MaterialOverrides {
  std::optional<ImageSize> size;
  std::optional<Orbit> orbit;
  std::optional<glm::dvec3> eye;  ///< world units, as target; not beside an orbit
  std::optional<glm::dvec3> target;
  std::optional<glm::dvec3> up;  ///< any length but 0: of the eye, or of how the model stands
  std::optional<double> roll_degrees;
  std::optional<double> zoom;
  std::optional<double> fov_degrees;  ///< not beside `orthographic`
  std::optional<OrthographicSize> orthographic;
  std::optional<std::string> engine;         ///< by name; the renderer has the list
  std::optional<std::vector<Light>> lights;  ///< not empty
  std::optional<glm::vec3> ambient;          ///< linear
  std::optional<std::filesystem::path> environment;
  std::optional<double> environment_rotation_degrees;  ///< counter-clockwise about what is up
  std::optional<Background> background;
  std::optional<double> exposure;  ///< stops, of a PNG
  std::optional<double> eye_dome;  ///< strength of eye-dome lighting
  std::optional<Outputs> outputs;
  OptionValues options;  ///< of engines, by key; those of other engines are ignored
};

/// Directions of view, for --view and scene files.
inline constexpr std::array<Named<Orbit>, 7> kViews{{{"front", {0.0, 0.0, 0.0}},
                                                     {"back", {180.0, 0.0, 0.0}},
                                                     {"left", {-90.0, 0.0, 0.0}},
                                                     {"right", {90.0, 0.0, 0.0}},
                                                     {"top", {0.0, 90.0, 0.0}},
                                                     {"bottom", {0.0, -90.0, 0.0}},
                                                     {"iso", {45.0, 35.26438968, 0.0}}}};

/// Up directions, likewise.
inline constexpr std::array<Named<glm::dvec3>, 6> kAxes{{{"x", {1.0, 0.0, 0.0}},
                                                         {"y", {0.0, 1.0, 0.0}},
                                                         {"z", {0.0, 0.0, 1.0}},
                                                         {"-x", {-1.0, 0.0, 0.0}},
                                                         {"-y", {0.0, -1.0, 0.0}},
                                                         {"-z", {0.0, 0.0, -1.0}}}};

struct SceneModel {
  std::filesystem::path file;
  Transform transform = {};
  MaterialOverrides material = {};     ///< overrides that of views
  std::optional<bool> is_closed = {};  ///< overrides the file's own flag
  OptionValues options = {};           ///< of engines, by key; override those of views
  std::string raw = {};                ///< layout of a volume without a header; empty: it has one
};

struct SceneView {
  std::string name;  ///< letters, digits, - _ . and no dot first, for use in a file name
  SceneSettings settings;
};

/// At least one model and one view; the views' names differ.
struct Scene {
  std::vector<SceneModel> models;
  SceneSettings settings;  ///< of all views, unless a view overrides them
  std::vector<SceneView> views;
};

/// Limits of a scene file, which may be hostile.
inline constexpr std::size_t kMaxSceneBytes = std::size_t{1} << 20U;
inline constexpr std::size_t kMaxSceneModels = 1000;
inline constexpr std::size_t kMaxSceneViews = 10000;
/// Coordinates in a scene file, world units: beyond this limit, doubles are more than 1e-4 apart.
inline constexpr double kMaxSceneCoordinate = 1e12;

/// Reads a scene file. `engines`: the engines and options that it may name. Trusts nothing: fails,
/// with one sentence that names the position in the file, at unknown or repeated keys, wrong types,
/// numbers out of range, and nesting or sizes beyond a scene's limits. Paths are relative to the
/// file's folder. No other file is opened.
Result<Scene> read_scene(const std::filesystem::path& path, const EngineKeys& engines);

/// Returns the different materials that the models set, in the models' order; at most
/// kMaxMaterials.
[[nodiscard]] std::vector<MaterialOverrides> distinct_materials(
    const std::vector<SceneModel>& models);

/// Returns the settings of `base`, overridden by those that `over` has. An orbit and an eye replace
/// each other, and so do a field of view and an orthographic image.
[[nodiscard]] SceneSettings overlay(SceneSettings base, const SceneSettings& over);

}  // namespace relief

// Materials: what a surface does with light.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>

#include "common/scene/choices.h"

namespace relief {

/// The parameters of materials.
struct MaterialConstants {
  /// Of Glass: its index of refraction, relative to its surroundings.
  float ior = 1.5F;
  /// Of Glass: how much light is lost along a diameter of the body, as an exponent for each of R, G
  /// and B (Beer-Lambert), so that it does not depend on the model's size. With one interface a
  /// ray's path is that through a sphere: the diameter times the cosine of the angle at which the
  /// ray is refracted. With two it is the ray's own, over the diameter of the model's bounding
  /// sphere.
  glm::vec3 absorption{0.0F};
  /// Of Mirror and Split, and of Lit in the light of an environment: 0 is smooth; the width of the
  /// microfacets' GGX distribution is its square.
  float roughness = 0.0F;
  /// Of any kind: the share of the background that a surface covers. 1 is opaque.
  float opacity = 1.0F;
  /// Of Glass: 1 refracts light where it enters; 2 also where it leaves.
  int interfaces = 1;

  bool operator==(const MaterialConstants&) const = default;
};

struct MaterialSettings {
  Material kind = Material::Lit;
  MaterialConstants constants;

  bool operator==(const MaterialSettings&) const = default;
};

/// Ranges of the parameters, on the command line and in scene files.
inline constexpr NumberChoice kRefractiveIndices{1.0, 4.0};
inline constexpr NumberChoice kAbsorptions{0.0, 100.0};
inline constexpr NumberChoice kRoughnesses{0.0, 1.0};
inline constexpr NumberChoice kOpacities{0.0, 1.0};
inline constexpr NumberChoice kInterfaceCounts{1, 2};

/// Maximum number of materials of a scene, and of roughnesses above 0 in an image: each roughness
/// has its own environment of up to 16 MB.
inline constexpr std::size_t kMaxMaterials = 256;
inline constexpr std::size_t kMaxRoughnesses = 16;

/// The material parameters that the command line, a scene, a view or a model sets.
struct MaterialOverrides {
  std::optional<Material> material;
  std::optional<double> ior;
  std::optional<glm::vec3> absorption;
  std::optional<double> roughness;
  std::optional<double> opacity;
  std::optional<int> interfaces;

  bool operator==(const MaterialOverrides&) const = default;
};

/// The settings of `base`, overridden by those that `over` has.
[[nodiscard]] MaterialOverrides overlay_material(MaterialOverrides base,
                                                 const MaterialOverrides& over);

/// The material with those settings; the others are as in MaterialSettings.
[[nodiscard]] MaterialSettings material_of(const MaterialOverrides& overrides);

}  // namespace relief

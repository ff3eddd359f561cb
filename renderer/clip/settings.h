// What can be chosen about clipping splats at sharp features.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/scene/choices.h"

namespace relief {

/// How a splat that crosses a sharp edge is clipped by its clip partners. All but Off and Partners
/// are rivals of section VI of [Ivo 2011].
enum class ClipRule : std::uint8_t {
  Off,
  Partners,     ///< union or intersection of the clipped areas, by how the partners lie (Figure 5)
  Nearest,      ///< the nearest partner alone [Zwicker 2004]
  Independent,  ///< the union of all clipped areas [Zwicker 2004]
  Wicke         ///< the two partners nearest to each fragment [Wicke 2004]
};

inline constexpr std::array<Named<ClipRule>, 5> kClipRules{{{"off", ClipRule::Off},
                                                            {"partners", ClipRule::Partners},
                                                            {"nearest", ClipRule::Nearest},
                                                            {"independent", ClipRule::Independent},
                                                            {"wicke", ClipRule::Wicke}}};

/// Which normals the classification takes, and, of points, the engines that clip them.
enum class ClipNormals : std::uint8_t {
  Given,  ///< the model's
  Refit   ///< fitted anew to the neighbours on the same side of an edge
};

inline constexpr std::array<Named<ClipNormals>, 2> kClipNormals{
    {{"given", ClipNormals::Given}, {"refit", ClipNormals::Refit}}};

inline constexpr NumberChoice kClipThresholds{-1.0, 1.0};

struct ClipSettings {
  ClipRule rule = ClipRule::Off;
  /// w_s of Eq. (2): splats whose normals have a smaller dot product are of different surfaces.
  /// None: from the measured noise of the normals.
  std::optional<double> threshold;
  ClipNormals normals = ClipNormals::Given;

  bool operator==(const ClipSettings&) const = default;
};

}  // namespace relief

// What can be chosen about textured surfels ([Textured surfels]).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/scene/choices.h"

namespace relief {

/// What a surfel's diameter is found from (section 3.3).
enum class SurfelSize : std::uint8_t {
  BspEdge,    ///< the mean edge of the triangle that its cluster of a BSP makes
  BspCircle,  ///< the diameter of that triangle's circumscribed circle
  Qsplat,     ///< the spheres of a hierarchy, as QSplat has them
  Cell,       ///< the circle about its Voronoi cell among its neighbours
  Given       ///< what the points come with: their spacing, or that of a patch's samples
};

/// Which surfels are slightly curved surfaces instead of plain polygons (Figure 2).
enum class SurfelCurved : std::uint8_t {
  Auto,  ///< those at the silhouette
  All,
  None
};

/// How overlapping surfels become one colour (section 3.1).
enum class SurfelBlend : std::uint8_t {
  Normalised,  ///< the mean of what is near the front surface, by the alpha texture
  Sorted       ///< back to front, each over what is behind it
};

inline constexpr std::array<Named<SurfelSize>, 5> kSurfelSizes{
    {{"bsp-edge", SurfelSize::BspEdge},
     {"bsp-circle", SurfelSize::BspCircle},
     {"qsplat", SurfelSize::Qsplat},
     {"cell", SurfelSize::Cell},
     {"given", SurfelSize::Given}}};
inline constexpr std::array<Named<SurfelCurved>, 3> kSurfelCurved{
    {{"auto", SurfelCurved::Auto}, {"all", SurfelCurved::All}, {"none", SurfelCurved::None}}};
inline constexpr std::array<Named<SurfelBlend>, 2> kSurfelBlends{
    {{"normalised", SurfelBlend::Normalised}, {"sorted", SurfelBlend::Sorted}}};

inline constexpr NumberChoice kSurfelSides{3, 64};
inline constexpr NumberChoice kSurfelScales{0.1, 16.0};
inline constexpr NumberChoice kSurfelFalloffs{0.05, 8.0};
inline constexpr NumberChoice kSurfelOffsets{0.0, 1e12};

struct SurfelSettings {
  SurfelSize size = SurfelSize::Cell;
  std::optional<double> scale;  ///< of the diameters; none: what closes the gaps of `size`
  int sides = 3;                ///< of the polygons, which hold the surfels' discs
  SurfelCurved curved = SurfelCurved::Auto;
  SurfelBlend blend = SurfelBlend::Normalised;
  double falloff = 0.5;          ///< h of section 3.1, over the surfel's radius
  std::optional<double> offset;  ///< z_0 of section 3.2, world units; none: from the spacing
};

}  // namespace relief

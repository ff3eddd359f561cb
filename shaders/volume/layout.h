// What C++ and the shaders of volumes must agree on.
// C++ includes it as "shaders/volume/layout.h"; shaders as "volume/layout.h".
#pragma once

#include "shaders/include/shared.h"

#ifdef __cplusplus
namespace relief::shared {
using glm::uvec4;
#endif

// Outputs: colour times opacity and the transmittance; normal (any length) and depth.
#define RELIEF_VOLUME_OUT_COLOUR 0
#define RELIEF_VOLUME_OUT_SURFACE 1

// Binding points of these passes.
#define RELIEF_VOLUME_BIND_RULE 0
#define RELIEF_VOLUME_BIND_GRID 1
#define RELIEF_VOLUME_BIND_NODES 2
#define RELIEF_VOLUME_BIND_FRAME 3
#define RELIEF_VOLUME_TEXTURE_SPLATS 0
#define RELIEF_VOLUME_TEXTURE_ENTRIES 1
#define RELIEF_VOLUME_TEXTURE_STARTS 2
#define RELIEF_VOLUME_TEXTURE_NODES 0
#define RELIEF_VOLUME_TEXTURE_DISTANCES 1
#define RELIEF_VOLUME_TEXTURE_NORMALS 2
#define RELIEF_VOLUME_TEXTURE_SQUARES 3
#define RELIEF_VOLUME_TEXTURE_SHEET_DISTANCES 4
#define RELIEF_VOLUME_TEXTURE_LIMITS 6

// VolumeRule::flags.
#define RELIEF_VOLUME_PEAK 1u         // weights are opacities, not optical depths
#define RELIEF_VOLUME_EXPONENTIAL 2u  // attenuation
#define RELIEF_VOLUME_SLABS 4u        // groups are slabs
#define RELIEF_VOLUME_LIMITED 8u      // opaque surfaces end what pixels show

/// A kernel's footprint (renderer/volume/splats/footprint.h), as float texels.
struct VolumeSplat {
  vec4 place;   ///< centre (pixels from the lower left corner), cutoff, peak
  vec4 shape;   ///< Q: xx, xy, yy (1 / pixels squared); w: depth
  vec4 colour;  ///< rgb as it is blended; w: deviation of depths
  vec4 normal;  ///< xyz; w unused
  vec4 slope;   ///< xy: of depths, world units a pixel
};

/// How layers are composited, and in which tiles.
struct VolumeRule {
  uvec4 image;  ///< width, height, tiles in a row, flags
  vec4 limits;  ///< smallest and largest alpha of a contribution, smallest transmittance, 0
  vec4 slabs;   ///< where the first one begins, and how thick they are, world units; 0, 0
};

/// A regular grid as the rays of an image meet it. Sheet coordinates: u and v in a sheet, w across,
/// in nodes of the box that holds all kernels; x and y are pixels from the image's middle.
/// A ray at the sheet w is where (place + (w - middle) * along.xy) / along.z says, at the depth
/// (depth + w - middle) / along.z, where each is a linear function of x and y.
struct VolumeGrid {
  vec4 place_origin;  ///< xy: at the image's middle; z: depth there; w: the middle sheet
  vec4 place_x;       ///< xyz: change for a pixel to the right; w: extinction of a texel's 1
  vec4 place_y;       ///< xyz: for a pixel upward; w: colour of a texel's 1
  vec4 along_origin;  ///< index steps for a unit of depth; w: 1 if the camera is orthographic
  vec4 along_x;       ///< w: where the axis is, pixels from the image's middle: x
  vec4 along_y;       ///< w: likewise y
  vec4 kernel;        ///< variance of kernels (nodes squared), cutoff of q, near, filter's variance
  vec4 camera;        ///< pixels for a slope of 1 to the right and upward; 1: scales uniformly; 0
  ivec4 u;            ///< xyz: the texel beside along u; w: texels along it
  ivec4 v;
  ivec4 w;
};

/// A regular grid's nodes as they are lit. Nodes of the box that holds all kernels.
struct VolumeNodes {
  vec4 from_eye;  ///< from the eye to node (0, 0, 0), world units
  vec4 step_x;    ///< world
  vec4 step_y;
  vec4 step_z;
  vec4 size;  ///< nodes along x, y, z; w: albedo of a texel's 1
};

RELIEF_CONST int kVolumeSquare = 16;     ///< nodes along the side of what is lit in one piece
RELIEF_CONST int kVolumeSheetBlock = 2;  ///< nodes along the side of a square of a sheet
RELIEF_CONST int kVolumeBlock = 4;       ///< nodes along a block's side
RELIEF_CONST int kVolumeSplatRows = 5;
RELIEF_CONST int kVolumeTile = 16;  ///< pixels along a tile's side

#ifdef __cplusplus
static_assert(sizeof(VolumeSplat) == 16 * kVolumeSplatRows);
static_assert(sizeof(VolumeGrid) == 176 && offsetof(VolumeGrid, u) == 128);
static_assert(sizeof(VolumeNodes) == 80 && offsetof(VolumeNodes, size) == 64);
static_assert(sizeof(VolumeRule) == 48 && offsetof(VolumeRule, limits) == 16);
}  // namespace relief::shared
#endif

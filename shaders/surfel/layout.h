// What C++ and the shaders of the engine `surfel` must agree on.
// C++ includes it as "shaders/surfel/layout.h"; shaders as "surfel/layout.h".
#pragma once

#include "shaders/include/shared.h"

#ifdef __cplusplus
namespace relief::shared {
using glm::uvec4;
#endif

// Binding points beside those of shared.h. Tables are buffer textures for the reason given there.
#define RELIEF_SURFEL_BIND_FRAME 3
#define RELIEF_SURFEL_TEXTURE_DRAWN 30
#define RELIEF_SURFEL_TEXTURE_CORNERS 31
#define RELIEF_SURFEL_TEXTURE_AXES 32
#define RELIEF_SURFEL_TEXTURE_BENDS 33
#define RELIEF_SURFEL_TEXTURE_COLOURS 34
#define RELIEF_SURFEL_TEXTURE_IDENTITIES 35
#define RELIEF_SURFEL_TEXTURE_TEXCOORDS 36
#define RELIEF_SURFEL_TEXTURE_IMAGE 37

/// Uniforms of what draws surfels: the first of the draw in the list of drawn ones, and how many
/// bits of a vertex's number say which corner it is; 0: it is one of three.
#define RELIEF_SURFEL_UNIFORM_FIRST 0
#define RELIEF_SURFEL_UNIFORM_CORNER_BITS 1

/// A surfel that a frame draws: where it is from the eye (world axes, three floats as bits), and
/// its number in the tables.
struct DrawnSurfel {
  uint x;
  uint y;
  uint z;
  uint number;
};

/// What a frame's surfels share.
struct SurfelFrame {
  mat4 clip_from_eye;  ///< from positions relative to the eye, world axes
  /// x: exponent of 2 of the weight at the rim, negated; y: set-back of the first pass in radii,
  /// z: the same in world units, which are added; w: 1 with the rule of Wicke.
  vec4 rule;
};

/// What the second pass keeps beyond a disc's rim and its clip lines, in radii: no pixel that the
/// first one covers up to there may be without weight for rounding.
RELIEF_CONST float kSurfelSlack = 1e-4f;

/// Rows of a surfel's axes: u and v, as long as its radius; w of the first: its radius.
RELIEF_CONST int kSurfelAxesRows = 2;

/// Rows of a surfel's texture coordinates: at its centre, and their changes along u; those along v;
/// the colour of a surfel without coordinates, with 1 in w, else 0.
RELIEF_CONST int kSurfelTexcoordRows = 3;

#ifdef __cplusplus
static_assert(sizeof(DrawnSurfel) == 16 && sizeof(SurfelFrame) == 80);
}  // namespace relief::shared
#endif

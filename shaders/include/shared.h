// What C++ and GLSL must agree on: feature bits, binding points, constants, memory layouts.
// C++ includes it as "shaders/include/shared.h"; shaders as "include/shared.h".
#pragma once

#ifdef __cplusplus
#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#define RELIEF_CONST inline constexpr
namespace relief::shared {
using uint = std::uint32_t;
using glm::ivec4;
using glm::mat4;
using glm::vec4;
#else
#define RELIEF_CONST const
#endif

// Feature bits: with the number of lights, the key of a shader variant
// (renderer/gl/shader/features.h, which also lists what does not go together). They come only from
// the scene and the settings; each says what it costs a frame that has it. All 32 are in use. The
// lights are a word of their own, RELIEF_LIGHTS, so that the loop over them is known when a shader
// is compiled: a light more is a highlight per fragment.

// Sprites, ray-cast in the fragment stage; writes gl_FragDepth, so that no fragment is rejected
// before it is shaded. Without it: quads with their own depth.
#define RELIEF_FEATURE_SPRITE 1u
// The sprites that would be too large for OpenGL, as quads clipped to the disc: one more draw over
// the patches that are near enough.
#define RELIEF_FEATURE_LARGE_SPRITES 2u
// Corrected interpolation: three heights and one plane intersection per fragment.
#define RELIEF_FEATURE_CORRECTED 4u
// A colour map: one lookup per fragment.
#define RELIEF_FEATURE_COLOURS 8u
// Beside COLOURS: some map has more texels a cell than 2, as textured meshes have. Mip levels and
// anisotropic filtering: 1 to 16 trilinear lookups instead of the one, and a third more bytes. Of
// `multipass` a lookup per fragment instead of one per splat.
#define RELIEF_FEATURE_FINE_COLOURS 262144u
// Some normal map has more texels a cell than 1, as meshes with normal maps have, and the features
// read normals: the same for them. Cells are then shaded as they are found, and `multipass` looks
// normals up per fragment.
#define RELIEF_FEATURE_FINE_NORMALS 524288u
// Materials: none is unlit; several only beside MIXED or SPLIT. All need the normal map: one lookup
// per fragment. A mirror has one more, of the environment; glass two.
#define RELIEF_FEATURE_LIT 16u
#define RELIEF_FEATURE_MIRROR 32u
// Beside LIT: light comes from the environment, too: nine terms for what is scattered, and one
// lookup for what is reflected.
#define RELIEF_FEATURE_ENVIRONMENT_LIGHT 33554432u
// Those that look the environment up.
#define RELIEF_REFLECTING_FEATURES \
  (RELIEF_FEATURE_MIRROR | RELIEF_FEATURE_GLASS | RELIEF_FEATURE_ENVIRONMENT_LIGHT)
// Outputs beside the colour: an attachment of 8, 4, 8 and 4 bytes a pixel each.
#define RELIEF_FEATURE_OUT_NORMAL 64u
#define RELIEF_FEATURE_OUT_DEPTH 128u
#define RELIEF_FEATURE_OUT_UV 256u
#define RELIEF_FEATURE_OUT_PATCH 512u

// Counts the fragments that are shaded: an atomic per fragment. Only in the one frame that counts;
// OpenGL's own statistics are wrong on llvmpipe (Mesa 22.3 says 0 or eight times too many).
#define RELIEF_FEATURE_COUNT_FRAGMENTS 1024u

// Cells: two triangles each, and splats only at the borders of patches. Sprites and quads draw
// nothing beside them.
#define RELIEF_FEATURE_CELL 2048u

// Coarser levels: what lies beyond the samples of a patch is cut off by its mask, one lookup per
// fragment; of cells only where a hole touches them, which is a second program.
#define RELIEF_FEATURE_MASKED 4096u

// Cells find the surface first and a pass over the image shades it, each pixel once: 8 bytes a
// pixel more, 12 where depth is needed. Triangles of a few pixels would shade several times as many
// as they cover.
#define RELIEF_FEATURE_VISIBILITY 8192u

// Semi-transparent surfaces, found and shaded one behind the other: for each layer a pass of both
// kinds, until one finds nothing. Two depths and two words are read per fragment.
#define RELIEF_FEATURE_LAYERED 65536u

// A material, as LIT and MIRROR above: two lookups of the environment.
#define RELIEF_FEATURE_GLASS 1048576u
// Beside GLASS: light is refracted where it leaves the body, too. One more pass that finds
// surfaces, those seen from behind, into 16 bytes a pixel, and 4 bytes more of the one that finds
// what is in front; four lookups of a position, a patch and a normal there per fragment.
#define RELIEF_FEATURE_TWO_INTERFACES 16777216u
// The split view: all of LIT and MIRROR, which it has beside it, and the sample that is nearest.
#define RELIEF_FEATURE_SPLIT 131072u
// Several materials in one image: a patch names its own. All that there are bits for are computed
// for every fragment, and one of them is taken.
#define RELIEF_FEATURE_MIXED 2097152u
// Beside MIXED: some mirrors are rough, which is one more lookup. (Alone a rough mirror costs what
// a smooth one does.)
#define RELIEF_FEATURE_ROUGH 8388608u
// Some light is a point: a position and two roots per fragment and light.
#define RELIEF_FEATURE_POINT_LIGHTS 4194304u

// Sprites of closed bodies are not drawn where they face away from the eye: a product per vertex.
// (Triangles are left out by OpenGL, which needs no variant.)
#define RELIEF_FEATURE_FRONT 32768u

// Splats of `multipass` and `surfel` that clip lines cut at sharp edges: in both passes over them a
// loop over the lines of a splat, one lookup each. Patches that have no such splat are drawn
// without it.
#define RELIEF_FEATURE_CLIPPED 67108864u
// Beside CLIPPED: the rule of Wicke, for comparison: three lookups a line, twice.
#define RELIEF_FEATURE_CLIP_WICKE 134217728u
// Beside CLIPPED: the output that says how splats are clipped, an attachment of one byte a pixel.
// All patches are drawn as those with clipped splats are.
#define RELIEF_FEATURE_OUT_CLIP 268435456u

// Splats of `multipass` and `surfel` blend with those alone of which the eye sees the same side as
// of the one in front: where back sides are drawn, they lie within the depth of blending behind
// every contour. An attachment of one byte a pixel, and a lookup a fragment of the second pass.
#define RELIEF_FEATURE_SIDED 2147483648u

// An orthographic camera: rays begin all over the plane through the eye, and depth values are
// linear (include/projection.glsl). Costs nothing: it saves divisions.
#define RELIEF_FEATURE_ORTHOGRAPHIC 16384u

// Surfels of `surfel` that bend with the surface: more triangles a surfel, and a normal that is
// interpolated.
#define RELIEF_FEATURE_CURVED 536870912u
// Surfels are blended one over the other, so that each fragment is shaded.
#define RELIEF_FEATURE_SORTED 1073741824u

// Locations of the colour attachments.
#define RELIEF_OUT_COLOUR 0
#define RELIEF_OUT_NORMAL 1
#define RELIEF_OUT_DEPTH 2
#define RELIEF_OUT_UV 3
#define RELIEF_OUT_PATCH 4
#define RELIEF_OUT_CLIP 5
#define RELIEF_OUT_MATERIAL 6  // of the first pass of `surfel`, with several materials
#define RELIEF_OUT_SIDE 7      // of the first pass of `multipass` and `surfel`

// Outputs of the pass that finds the surface: the position, and its depth where it is needed.
#define RELIEF_OUT_VISIBILITY 0
#define RELIEF_OUT_VISIBILITY_DEPTH 1

// The same where `multipass` and `surfel` sum up splats: normal, colour, depth, each times its
// weight, and the weights.
#define RELIEF_SUM_NORMAL 0
#define RELIEF_SUM_COLOUR 1
#define RELIEF_SUM_DEPTH 2

// Binding points: one uniform block, one storage buffer, else texture units. The tables are buffer
// textures, not storage buffers: llvmpipe reads a storage buffer lane by lane, and not at all in
// helper invocations, which spoils derivatives (measured: docs/decisions/0065).
#define RELIEF_BIND_FRAME 0
#define RELIEF_BIND_MATERIALS 1
#define RELIEF_BIND_BACK_FRAME 2
#define RELIEF_BIND_FRAGMENT_COUNT 0
#define RELIEF_TEXTURE_HEIGHTS 0
#define RELIEF_TEXTURE_NORMALS 1
#define RELIEF_TEXTURE_COLOURS 2
#define RELIEF_TEXTURE_ENVIRONMENT 3
#define RELIEF_TEXTURE_SAMPLES 4
#define RELIEF_TEXTURE_PATCHES 5
#define RELIEF_TEXTURE_PATCH_VIEWS 6
#define RELIEF_TEXTURE_CELL_HEIGHTS 7
#define RELIEF_TEXTURE_CELL_ROWS 8
#define RELIEF_TEXTURE_CELL_RUNS 9
#define RELIEF_TEXTURE_RIMS 10
#define RELIEF_TEXTURE_NORMAL_SUMS 11
#define RELIEF_TEXTURE_COLOUR_SUMS 12
#define RELIEF_TEXTURE_DEPTH_SUMS 13
#define RELIEF_TEXTURE_VISIBLE_DEPTH 14
#define RELIEF_TEXTURE_MASKS 15
#define RELIEF_TEXTURE_VISIBILITY 16
#define RELIEF_TEXTURE_VISIBILITY_DEPTH 17
#define RELIEF_TEXTURE_LAYER_DEPTH 18
#define RELIEF_TEXTURE_PROXY_VERTICES 19

#define RELIEF_TEXTURE_ROUGH_ENVIRONMENTS 20
#define RELIEF_TEXTURE_PATCH_IDS 21
#define RELIEF_TEXTURE_PIXEL_SAMPLES 22
#define RELIEF_TEXTURE_PROXY_SOURCES 23
#define RELIEF_TEXTURE_BACK_COORDINATES 24
#define RELIEF_TEXTURE_BACK_DEPTHS 25
#define RELIEF_TEXTURE_BODIES 26
#define RELIEF_TEXTURE_SEAM_VERTICES 27
#define RELIEF_TEXTURE_CLIP_RANGES 28
#define RELIEF_TEXTURE_CLIP_LINES 29
#define RELIEF_TEXTURE_BORDER_CELLS 30
#define RELIEF_TEXTURE_SIDES 38

/// Uniform of `multipass`: radius of its discs over that of Eq. (1) of [Ochotta 2008].
#define RELIEF_UNIFORM_RADIUS_FACTOR 0

/// Uniform of `onepass`: steps a cell of the positions that it notes (visibility.glsl).
#define RELIEF_UNIFORM_POSITION_STEPS 1

/// Uniform of programs that draw sprites with FRONT: whether this draw leaves the backs out.
#define RELIEF_UNIFORM_FRONT 2

/// Uniform of the bench's shading bound: the patch that it shades.
#define RELIEF_UNIFORM_PATCH 0

/// Uniform that averages samples: where its part of the image is, and how many it has.
#define RELIEF_UNIFORM_PART 0

/// Uniforms of what brings a picture into a window: factor of its light, strength of eye-dome
/// lighting, what steps of linear depth values are measured in.
#define RELIEF_UNIFORM_EXPOSURE 0
#define RELIEF_UNIFORM_SHADE 1
#define RELIEF_UNIFORM_DEPTH_SCALE 2

/// Texture units and uniforms of the pass that shows outputs of a view in colours, where no model
/// is bound: which output (inspected_output() of viewer/inspecting/inspection.h), where its part of
/// the picture is and how many samples it has, the world direction toward the eye, the value of the
/// scale's end.
#define RELIEF_TEXTURE_INSPECTED_COLOUR 0
#define RELIEF_TEXTURE_INSPECTED_NORMAL 1
#define RELIEF_TEXTURE_INSPECTED_UV 2
#define RELIEF_TEXTURE_INSPECTED_PATCH 3
#define RELIEF_TEXTURE_INSPECTED_LEVELS 4
#define RELIEF_TEXTURE_INSPECTION_COLOURS 5
#define RELIEF_UNIFORM_INSPECTION 0
#define RELIEF_UNIFORM_INSPECTED_PART 1
#define RELIEF_UNIFORM_TOWARD_EYE 2
#define RELIEF_UNIFORM_SCALE_END 3

/// Vertex attributes: the patch that a draw command draws, through its base instance; with cells
/// also the corner of the part that it draws (column, then row in the upper half).
#define RELIEF_ATTRIBUTE_PATCH 0
#define RELIEF_ATTRIBUTE_CORNER 1

/// Vertex attributes of the mesh of `relief bench` and of a scan's points in the window.
#define RELIEF_ATTRIBUTE_POSITION 0
#define RELIEF_ATTRIBUTE_NORMAL 1
#define RELIEF_ATTRIBUTE_COLOUR 2

/// A position that was found is two words: grid coordinates in the lower bits, counted in steps
/// from kVisibilityBegin cells before the first node, and half the number of its patch in each of
/// the upper ones. The highest bit says whether the back is seen.
RELIEF_CONST uint kVisibilityBits = 22u;
RELIEF_CONST uint kVisibilityMask = (1u << kVisibilityBits) - 1u;
RELIEF_CONST uint kVisibilityPatchBits = 32u - kVisibilityBits;  ///< in the second word one less
RELIEF_CONST uint kVisibilityBehind = 0x80000000u;
RELIEF_CONST float kVisibilityBegin = 4.0f;

/// Patches overlap, and so do a patch's border splats and its cells: what is nearer than this
/// behind a semi-transparent surface, in spacings along the view axis, is the same surface.
RELIEF_CONST float kLayerGap = 1.5f;

/// The height texel of a hole.
RELIEF_CONST uint kHoleTexel = 65535u;

/// A sample record is four words. First word: column, row, border flag; second word: height index,
/// then the slope along both axes as signed bytes; third and fourth word: reaches and gaps toward
/// -x, +x, -y and +y, a byte each.
RELIEF_CONST uint kRowShift = 14u;
RELIEF_CONST uint kNodeMask = 0x3FFFu;
RELIEF_CONST uint kBorderBit = 0x80000000u;

/// A run of cells is a word: its first node's column and row in the part, its cells, and how far
/// the depth of its nodes at the patch's border is set back, in steps of kSetBackStep cells. It is
/// drawn as a strip of kRunVertices vertices, the first and the last of them twice so that strips
/// of several runs hang together by empty triangles; what a run is shorter than kRunCells is empty
/// too.
RELIEF_CONST int kRunCells = 14;
RELIEF_CONST int kRunVertices = 2 * kRunCells + 4;  // a power of two, which shaders divide by

/// The same of the runs of a level's edge: what holes touch are mostly one or two cells in a row.
RELIEF_CONST int kEdgeRunCells = 2;
RELIEF_CONST int kEdgeRunVertices = 2 * kEdgeRunCells + 4;
RELIEF_CONST uint kNodeInPartBits = 8u;
RELIEF_CONST uint kNodeInPartMask = 0xFFu;
RELIEF_CONST uint kRunCellsMask = 0xFu;
RELIEF_CONST uint kSetBackShift = 20u;
RELIEF_CONST float kSetBackStep = 1.0f / 32.0f;

/// A node of a strip of a part's cells is its column in the part and, shifted, its row.
RELIEF_CONST uint kStripRowShift = 5u;
RELIEF_CONST uint kStripColumnMask = (1u << kStripRowShift) - 1u;

/// A border cell (renderer/geometry/cells/patch_border.h) is two words. The first: column and row
/// of its lower left node in the part, plus one; the corners of its polygon (BorderPolygon::slots);
/// how far it is set back, as a run. The second: of its edges how far from the sample to the hole
/// the polygon reaches, a byte each, in steps of kBorderStep cells. It is drawn as a fan of three
/// triangles, some of them empty.
RELIEF_CONST uint kBorderSlotsShift = 16u;
RELIEF_CONST uint kBorderSetBackShift = 24u;
RELIEF_CONST float kBorderStep = 1.0f / 255.0f;
RELIEF_CONST int kBorderVertices = 9;

/// Cells of a part of a patch, each way: two runs. What faces away is left out part by part: a
/// quarter of the Dragon's runs, a third in parts of 14. In parts of 7 commands and short runs cost
/// more than that saves (166 ms a frame at the finest level, 127 in parts of 28).
RELIEF_CONST uint kPartCells = 28u;

/// Cells high, per step of a gap. Half a step is what rounded slopes and heights make, which
/// kMinMargin closes.
RELIEF_CONST float kGapStep = 0.01f;

/// The largest margin that closes a gap, in spacings along the splat's plane. iron_scan, holes in
/// twelve views of 1280x1024, and the Dragon, lit and direct, against a ray-traced truth: 0.6: 7,
/// 37.9 dB; 0.75: 5, 37.7 dB; margins for 30 degrees in all views and 0.5 at most: 76, 38.4 dB.
RELIEF_CONST float kLargestMargin = 0.75f;

/// Rays that approach a splat's plane by less per cell have the margin for this.
RELIEF_CONST float kLowestView = 0.1f;

/// Slopes (height per cell, both in cells) are clamped to this: 79 degrees.
RELIEF_CONST float kSteepest = 5.0f;

/// How far a splat extends over the base plane, in cells, per step of its reaches.
RELIEF_CONST float kReachStep = 1.0f / 160.0f;

/// What every splat extends beyond where it meets the next, in cells: slopes and heights are
/// rounded.
RELIEF_CONST float kMinMargin = 0.02f;

/// The same in pixels: OpenGL snaps corners to 1/256 pixel, which parts the quads of a model that
/// is far away.
RELIEF_CONST float kMarginPixels = 0.02f;

/// How far the depth of a border splat is set back, in cells, over the cosine of its tilt: what
/// sticks out of a patch must not cover the surface of the next, and sticks out more where it is
/// steep.
RELIEF_CONST float kBorderSetBack = 0.5f;

/// A sample whose splat's plane is off the cells by more where it ends, in cells along its normal,
/// has a splat beside the cells: they cut corners off that the planes meet in. fandisk, pixels
/// missing in twelve views of 1280x1024, and the Dragon's bytes a sample: none 155, 3.87; 0.3
/// 99, 3.90; 0.2 31, 3.93; 0.15 20, 3.99; 0.1 15, 4.15; 0.05 15, 4.98.
RELIEF_CONST float kCrease = 0.15f;

/// A position is on the surface if it is no higher or lower than this, in cells.
RELIEF_CONST float kOnSurface = 0.03f;

/// A view ray that passes the surface by more, in cells, has met what sticks out of it. Less than
/// that is the edge of a crease, which no sample lies on: fandisk, pixels missing in twelve views
/// of 1280x1024: at 0.15 19, at 0.2 2, at 0.25 none.
RELIEF_CONST float kLargestMiss = 0.25f;

/// Half cells by which the surface is searched for to both sides.
RELIEF_CONST int kSearchSteps = 3;

/// How far apart along the view axis splats may be that `multipass` blends, in spacings. Fandisk,
/// lit, against a ray-traced truth: 0.5: 31.8 dB, 1: 31.9 dB, 1.5: 31.2 dB.
RELIEF_CONST float kBlendingDepth = 1.0f;

/// The same as a part of the depth: what 32-bit depth values can tell apart with certainty.
RELIEF_CONST float kMinBlendingDepth = 1e-5f;

/// The weights of `multipass` fall to 2^(-kGaussianFall f) at the rim of discs with radius factor
/// f. Factor 2 against ray-traced truths, mirror in dB, of the Dragon whole / near / fandisk near:
/// 2: 27.1 / 23.0 / 19.7; 3.5: 27.2 / 23.6 / 21.3; 5: 27.2 / 23.5 / 20.0; 10: - / 22.0 / 17.1.
RELIEF_CONST float kGaussianFall = 4.0f;

/// How much larger than a splat's parallelogram its disc is at least: so much that no pixel of the
/// one misses the other for rounding.
RELIEF_CONST float kCoveringSlack = 1.001f;

/// The least radius of its discs, in pixels per radius factor. The Dragon at 640x512, factor 2: lit
/// 36.6 dB, mirror 27.3 dB; without 36.4 and 27.2.
RELIEF_CONST float kMinDiscPixels = 0.75f;

/// Lookups along a pixel's footprint on a fine map, at most.
RELIEF_CONST float kMaxFootprintLookups = 16.0f;

/// Linear reflectance of a model without colours: a neutral grey.
RELIEF_CONST float kNeutralGrey = 0.5f;

/// What clips a splat: two words a record, its first line and, shifted, the number of its lines;
/// below that how its partners lie (ClipKind). A line is a texel in the grid frame of the splat's
/// patch: (x, y) from the splat's centre is beyond it where dot(x, y) with the first two exceeds
/// the third, in cells; the fourth is 1 where its group ends. With CLIP_WICKE it has the plane of
/// its partner in two more: the centre from the splat's (cells; w: 1 if their edge is concave), the
/// normal.
RELIEF_CONST uint kClipKindBits = 3u;
RELIEF_CONST uint kClipKindMask = 7u;
RELIEF_CONST int kWickeTexels = 3;

/// What pass 2 of `multipass` keeps beyond a line, in cells and in pixels: no pixel that pass 1
/// covers up to it may be without weight for rounding.
RELIEF_CONST float kClipSlack = 0.01f;
RELIEF_CONST float kClipSlackPixels = 0.02f;

/// How far pass 2 sets clipped splats back that face away, in blending depths: all but a little
/// that planes of one surface differ by.
RELIEF_CONST float kClippedSetBack = 0.95f;

/// The most lights of an image.
RELIEF_CONST int kMaxLights = 16;

/// Eye-dome lighting (renderer/eye_dome.h): the factor of its strength, and how far away the
/// neighbours are, as a share of the image's height.
RELIEF_CONST float kEyeDomeFactor = 300.0f;
RELIEF_CONST float kEyeDomeRadius = 1.0f / 700.0f;

/// No light is brighter than this at a surface.
RELIEF_CONST float kBrightestLight = 1000.0f;

/// What an inspection shows, as C++ and GLSL number it.
RELIEF_CONST int kInspectPatches = 1;
RELIEF_CONST int kInspectNormals = 2;
RELIEF_CONST int kInspectLevels = 3;
RELIEF_CONST int kInspectCells = 4;
RELIEF_CONST int kInspectSamples = 5;
RELIEF_CONST int kInspectOverdraw = 6;

/// Colours of the scale of an inspection.
RELIEF_CONST int kInspectionColours = 256;

/// The most materials of an image.
RELIEF_CONST int kMaxMaterials = 256;

/// What MaterialInfo::constants begins with: the kind, as common/choices.h numbers them.
RELIEF_CONST int kUnlit = 0;
RELIEF_CONST int kLit = 1;
RELIEF_CONST int kMirror = 2;
RELIEF_CONST int kGlass = 3;
RELIEF_CONST int kSplit = 4;

/// Half the width of the line between the quarters of a split view, in pixels: two pixels where
/// their border is the image's middle, one where the middle is a pixel's.
RELIEF_CONST float kSplitLine = 0.75f;

/// Radius of the samples that it shows, in cells: less than the half with which discs touch.
RELIEF_CONST float kShownSample = 0.35f;

/// How often the position where a ray leaves a body of glass is made better. PSNR in dB of the
/// Dragon, the Bunny and Igea against the ray tracer (venice_sunset_1k.hdr, 640x512):
/// none 19.6, 18.5, 17.5; 1: 21.8, 20.6, 20.3 (both with another first guess); 2: 23.1, 21.8, 23.0;
/// 3: 23.2, 22.0, 23.0; 5: 23.3, 22.0, 23.0.
RELIEF_CONST int kExitSteps = 3;

/// Roughness of what is lit by an environment.
RELIEF_CONST float kLitRoughness = 0.5f;

/// A normal that points away from the eye by more (the cosine) is that of a back side, where
/// nothing else tells.
RELIEF_CONST float kBackSide = 0.6f;
/// The same where the back of a triangle is seen: at contours those of an overlapping patch stick
/// out. With 0.05 a sphere's contour has specks (5 dB), with 0.1 none.
RELIEF_CONST float kBackOfTriangle = 0.1f;

/// A material's constants.
struct MaterialInfo {
  /// Kind; index of refraction; layer of the rough environment that it reflects, below 0: the
  /// smooth one; interfaces of glass.
  vec4 constants;
  vec4 absorption;  ///< R, G, B: exponent over a diameter of the body; w: opacity
};

/// What does not change from frame to frame about a patch, or about one of its levels, whose cells
/// and nodes these are then; kPatchInfoRows texels of four integers.
struct PatchInfo {
  vec4 axis_u;    ///< world direction of grid axis u; w: spacing (world units)
  vec4 axis_v;    ///< of v; w: height of one height index, in cells
  vec4 axis_n;    ///< of the height; w: slope of one slope step
  ivec4 nodes;    ///< columns, rows, patch id, first of its rows for cells
  ivec4 heights;  ///< where its height map lies: texel x, y, layer; w: its material
  ivec4 normals;  ///< the same for the normal map; w: texels per cell
  ivec4 colours;  ///< the same for the colour map
  ivec4 masks;    ///< the same for the mask, where coarser levels are drawn
  vec4 extent;    ///< grid coordinates where the patch begins (x, y alike) and ends; w: its cells
                  ///< per cell
};

/// What the camera makes of a patch; kPatchViewRows texels of four floats. Grid frame: (column,
/// row, height) in cells.
struct PatchView {
  mat4 clip_from_grid;
  /// The eye in the grid frame; w: 0. Of an orthographic camera the direction of all rays there, of
  /// length 1; w: depth of the grid's origin along the view axis (world units).
  vec4 eye;
};

/// A vertex of the mesh that stands for a model seen from afar, four words: its position in the
/// mesh's frame (16 bits an axis), its colour (linear, half floats), the mean of its normals
/// (octahedral, 12 bits each, and its length).
struct ProxyVertex {
  uint position_xy;
  uint position_z_red;
  uint green_blue;
  uint normal;
};

/// A sample that it stands for: the patch, counted from the model's first, and its column and row.
struct ProxySource {
  uint patch_number;
  uint node;
};

/// A vertex of a patch's share of the seams.
struct SeamVertex {
  vec4 own;     ///< grid frame; w: from the patch's row of the table to that of its owner
  vec4 owners;  ///< the same position in the owner's grid frame
};

/// The camera of a scan's points.
struct PointFrame {
  mat4 clip_from_points;
  vec4 size;  ///< of a point: pixels at distance 1, the fewest and the most pixels
};

/// What all patches of a frame share.
struct Frame {
  vec4 ray_origin;  ///< world direction of unit depth through window position (0, 0); w: near
  vec4 ray_x;       ///< its change per pixel to the right; w: pixels per unit at depth 1
  vec4 ray_y;       ///< its change per pixel upward; w: largest sprite (pixels)
  /// Orthographic: world direction of all rays, of length 1; w: what depth values from 1 to 0 span
  /// from near on (world units), else 0. The rays' positions in the plane through the eye, relative
  /// to that, are then what ray_origin, ray_x and ray_y say.
  vec4 ray_along;
  vec4 viewport;                    ///< width, height, 1/width, 1/height (pixels)
  vec4 light_ambient;               ///< w: how much of each light a highlight shows
  vec4 light_position[kMaxLights];  ///< world; w 0: toward the light, 1: where it is from the eye
  vec4 light_colour[kMaxLights];
  vec4 irradiance[9];  ///< of the environment, in spherical harmonics (irradiance.h)
  /// Where the axes of the world are in the environment's frame; w is 0 (standing_cube.h).
  vec4 environment_from_world[3];
  MaterialInfo material;  ///< the image's, if it has but one
};

RELIEF_CONST int kPatchInfoRows = 9;
RELIEF_CONST int kPatchViewRows = 5;

#ifdef __cplusplus
static_assert(sizeof(PatchInfo) == 16 * kPatchInfoRows);
static_assert(offsetof(PatchInfo, nodes) == 48 && offsetof(PatchInfo, colours) == 96 &&
              offsetof(PatchInfo, extent) == 128);
static_assert(sizeof(ProxyVertex) == 16 && sizeof(ProxySource) == 8 && sizeof(SeamVertex) == 32);
static_assert(sizeof(PointFrame) == 80);
static_assert(sizeof(PatchView) == 16 * kPatchViewRows && offsetof(PatchView, eye) == 64);
static_assert(sizeof(Frame) == 320 + 32 * kMaxLights && offsetof(Frame, light_position) == 96);
}  // namespace relief::shared
#endif

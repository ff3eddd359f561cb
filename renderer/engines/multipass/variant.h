// A shader variant of the engine `multipass`.
#pragma once

#include <cstdint>
#include <optional>

#include "common/error.h"
#include "renderer/frame/sample_draws.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/store/patch_store.h"

namespace relief::multipass {

/// A pass over the samples: as triangles, or as sprites and, where those would be too large for
/// OpenGL or reach behind the eye, as triangles.
struct SplatPrograms {
  Program all;
  std::optional<Program> large;  ///< with sprites
};

/// The passes over patches that have clipped splats.
struct ClippedPrograms {
  SplatPrograms visibility;
  SplatPrograms accumulation;
  bool shows_kinds = false;  ///< RELIEF_FEATURE_OUT_CLIP, which only these write: for all patches
};

/// The programs of some features, and the model that they draw. The model, its store and `gl` must
/// outlive it.
struct Variant {
  /// `features` from renderer/frame/features.h.
  static Result<Variant> create(const Gl& gl, const PatchStore& store, Features features);

  const Gl* gl;
  SampleDraws samples;
  SplatPrograms visibility;
  SplatPrograms accumulation;
  std::optional<ClippedPrograms> clipped;
  Program shading;
  VertexArray nothing;  ///< for the pass over the whole image
};

}  // namespace relief::multipass

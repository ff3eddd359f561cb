// The least that an image can cost: shading each of its pixels once.
#pragma once

#include <cstdint>
#include <memory>

#include "common/error.h"
#include "common/patch.h"
#include "renderer/frame/gl_engine.h"
#include "renderer/gl/open_gl.h"

namespace relief::bench_passes {

/// A pass over `pixels` pixels of an image, which shades the patch with the most nodes with the
/// image's material and lookups: no vertices to speak of, no depth, no overdraw. The model has at
/// least one patch.
Result<std::unique_ptr<GlPreparedModel>> prepare_shading_bound(std::shared_ptr<const OpenGl> opengl,
                                                               const PatchModel& model,
                                                               const RenderSettings& settings,
                                                               std::uint64_t pixels);

}  // namespace relief::bench_passes

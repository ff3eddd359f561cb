// Which images an engine can draw.
#pragma once

#include <span>

#include "common/error.h"
#include "renderer/engine_registry.h"

namespace relief {

/// Fails, with a sentence that names the engines which can, unless the engine draws the materials
/// of these settings from the model: opacities below 1, glass with two interfaces, the split view.
/// Fails if an output is asked for that the engine lacks. Fails also if the model has none of the
/// forms that the engine draws.
Status check_engine(const EngineEntry& engine, const RenderSettings& settings,
                    const RenderModel& model, std::span<const EngineEntry> among = engines());

/// Of that: a split view, of a model in that form.
Status check_split_view(const EngineEntry& engine, const RenderSettings& settings, ModelForm form,
                        std::span<const EngineEntry> among = engines());

}  // namespace relief

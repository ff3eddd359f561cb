// What `relief render` tells about the pictures that it has made.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cli/options/render_plan.h"
#include "renderer/render.h"

namespace relief::cli {

/// A picture that was written: what was asked of the renderer, and what came of it. The result's
/// image has no channels any more.
struct WrittenPicture {
  RenderSettings settings;
  RenderResult result;
};

/// The keys of DESIGN.md's `render`; with `explain`, if that was asked for.
[[nodiscard]] nlohmann::ordered_json as_json(const WrittenPicture& written);

/// {"views": [...]}, each with its name, its output and the keys of as_json. `written` is parallel
/// to the plan's pictures.
[[nodiscard]] nlohmann::ordered_json scene_as_json(const RenderPlan& plan,
                                                   const std::vector<WrittenPicture>& written);

/// The same for a person.
[[nodiscard]] std::string as_text(const Picture& picture, const WrittenPicture& written);

}  // namespace relief::cli

// The report of `relief render --explain`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "renderer/frame/explanation.h"

namespace relief::cli {

/// Features, variants, buffers, textures, passes and draws of a frame, and the bytes of all that is
/// there.
[[nodiscard]] nlohmann::ordered_json as_json(const Explanation& explanation);

/// Returns the explanation as indented text.
[[nodiscard]] std::string as_text(const Explanation& explanation);

}  // namespace relief::cli

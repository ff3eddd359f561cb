// The report of `relief render --explain`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cli/reports/cost_report.h"
#include "renderer/explanation/explanation.h"

namespace relief::cli {

/// Features, variants, buffers, textures, passes and draws of a frame, the bytes of all that is
/// there and of what was read of patch files, and what features cost if that was measured.
[[nodiscard]] nlohmann::ordered_json as_json(const Explanation& explanation, const FileBytes& read);

/// Returns the explanation as indented text.
[[nodiscard]] std::string as_text(const Explanation& explanation, const FileBytes& read);

}  // namespace relief::cli

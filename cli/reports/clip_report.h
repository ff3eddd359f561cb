// What `relief info --clip-partners` prints.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "renderer/clip/clip_partners.h"

namespace relief::cli {

/// Lines like those of `relief info`.
[[nodiscard]] std::string clips_as_text(const ClipCounts& counts);

[[nodiscard]] nlohmann::ordered_json clips_as_json(const ClipCounts& counts);

}  // namespace relief::cli

// The table of `relief render --explain-cost`: what each feature of an image costs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "common/patch_file/patch_file.h"
#include "renderer/explanation/feature_cost.h"

namespace relief::cli {

/// Bytes that were read of the scene's patch files; none if it has no such file.
using FileBytes = std::optional<SectionBytes>;

/// Returns the bytes of each kind of section, or null.
[[nodiscard]] nlohmann::ordered_json as_json(const FileBytes& read);

/// Returns the whole frame, the rest without any feature, and a row for each feature.
[[nodiscard]] nlohmann::ordered_json as_json(const FeatureCosts& costs, const FileBytes& read);

/// Returns the costs as an indented table.
[[nodiscard]] std::string as_text(const FeatureCosts& costs, const FileBytes& read);

}  // namespace relief::cli

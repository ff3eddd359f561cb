// JSON from strangers: text to a tree, strictly. Not a public header: it needs nlohmann::json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "common/error.h"

namespace relief {

/// Maximum depth of nesting; Relief's files need five levels.
inline constexpr std::size_t kMaxJsonDepth = 16;

/// Parses JSON (RFC 8259). Refuses, in one sentence that begins with `name`, text that is not
/// JSON (with line and column, both from 1, columns in bytes), numbers beyond double precision,
/// objects that have a key twice, and nesting deeper than kMaxJsonDepth.
Result<nlohmann::json> parse_json(std::string_view text, const std::string& name);

/// Whether all texts in a tree are UTF-8, which JSON has to be.
[[nodiscard]] bool is_utf8(const nlohmann::json& tree);

}  // namespace relief

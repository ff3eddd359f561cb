// Text in SVG and HTML.
#pragma once

#include <string>
#include <string_view>

namespace relief::cli {

/// The text as content or as an attribute in quotation marks. Control characters, which XML has
/// not, become spaces.
[[nodiscard]] std::string as_markup(std::string_view text);

}  // namespace relief::cli

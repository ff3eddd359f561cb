// File name extensions.
#pragma once

#include <filesystem>
#include <string>

namespace relief {

/// The extension of a path in lower case, with its dot (".relief"); empty if it has none.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& path);

}  // namespace relief

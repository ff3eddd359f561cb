// How a path that is being typed can go on.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace relief {

/// Entries of a folder that are looked at: a window waits for no more.
inline constexpr std::size_t kMostEntries = 20'000;
/// What a list has room for.
inline constexpr std::size_t kMostCompletions = 12;

/// Returns the path of a typed text: "~" and "~/..." are in the user's home.
[[nodiscard]] std::filesystem::path typed_path(std::string_view typed);

/// Returns how a typed path can go on, in alphabetical order: files that `accepts` takes and
/// folders, which end in "/". They begin as the text does, so that the text can be replaced by one
/// of them. Names that begin with a dot only if the typed one does. At most `most`.
[[nodiscard]] std::vector<std::string> complete_path(
    std::string_view typed, const std::function<bool(const std::filesystem::path&)>& accepts,
    std::size_t most = kMostCompletions);

/// Returns the longest text that all begin with; empty without any.
[[nodiscard]] std::string common_start(const std::vector<std::string>& texts);

/// Returns whether the extension, in lower case, is one of these: ".exr".
[[nodiscard]] bool has_extension(const std::filesystem::path& path,
                                 const std::vector<std::string>& extensions);

}  // namespace relief

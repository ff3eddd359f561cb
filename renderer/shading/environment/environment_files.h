// Which files an environment lies in.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "common/error.h"

namespace relief {

/// What stands for a face in the file name of an environment of six files.
inline constexpr std::string_view kFaceMark = "{face}";

/// The files of an environment: `path` itself or, where its file name has kFaceMark, those of six
/// faces in the order of cube maps: right, left, above, below, ahead, behind. They are named px nx
/// py ny pz nz, posx negx posy negy posz negz, or right left top bottom front back: that of these
/// sets of which most files exist (the first of equals). Fails if one does not exist; a path
/// without kFaceMark is not looked for.
Result<std::vector<std::filesystem::path>> environment_files(const std::filesystem::path& path);

}  // namespace relief

#include "renderer/shading/environment/environment_files.h"

#include <algorithm>
#include <array>

namespace relief {
namespace {

namespace fs = std::filesystem;

using FaceNames = std::array<std::string_view, 6>;

/// What today's tools write. Their names are those of the frame in which cube maps are specified
/// (OpenGL 4.5, section 8.13), in which +X is right of +Z: pz is ahead.
constexpr std::array<FaceNames, 3> kSets{{{"px", "nx", "py", "ny", "pz", "nz"},
                                          {"posx", "negx", "posy", "negy", "posz", "negz"},
                                          {"right", "left", "top", "bottom", "front", "back"}}};

bool exists(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

std::vector<fs::path> files_of(const fs::path& pattern, const FaceNames& names) {
  std::vector<fs::path> files;
  for (const std::string_view name : names) {
    std::string file = pattern.filename().string();
    for (std::size_t at = file.find(kFaceMark); at != std::string::npos;
         at = file.find(kFaceMark, at + name.size()))
      file.replace(at, kFaceMark.size(), name);
    files.push_back(pattern.parent_path() / file);
  }
  return files;
}

}  // namespace

Result<std::vector<fs::path>> environment_files(const fs::path& path) {
  if (path.filename().string().find(kFaceMark) == std::string::npos)
    return std::vector<fs::path>{path};
  std::vector<fs::path> best;
  std::ptrdiff_t most = 0;
  for (const FaceNames& names : kSets) {
    std::vector<fs::path> files = files_of(path, names);
    const std::ptrdiff_t there = std::count_if(files.begin(), files.end(), exists);
    if (there <= most) continue;
    most = there;
    best = std::move(files);
  }
  if (most == 0) {
    return make_error(
        "{}: there is no file of any face; {} stands for px nx py ny pz nz, for posx negx posy "
        "negy posz negz or for right left top bottom front back",
        path.string(), kFaceMark);
  }
  const auto missing = std::find_if_not(best.begin(), best.end(), exists);
  if (missing != best.end()) {
    return make_error("{}: there is no such file, which {} needs as one of six faces",
                      missing->string(), path.string());
  }
  return best;
}

}  // namespace relief

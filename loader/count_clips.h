// How the splats of a file would be clipped, without an image.
#pragma once

#include <filesystem>

#include "common/error.h"
#include "common/progress.h"
#include "preprocess/readers/read_points.h"
#include "renderer/clip/clip_partners.h"

namespace relief {

/// Counts the clip partners of a patch file's samples or a scan's points, as the engine `ewa` draws
/// them with its default cutoff. Fails if the file can't be read or the user interrupts.
Result<ClipCounts> count_clips(const std::filesystem::path& path, const ReadOptions& options,
                               const ClipSettings& settings, Progress& progress);

}  // namespace relief

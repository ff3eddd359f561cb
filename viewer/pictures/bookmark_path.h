// Bookmarks as the path of a camera.
#pragma once

#include "common/error.h"
#include "common/scene/views/camera_path.h"
#include "viewer/navigation/bookmarks.h"

namespace relief {

/// How a path goes through bookmarks.
struct PathChoice {
  double frames_per_second = kUsualFrameRate;  ///< in kFrameRates
  bool is_loop = false;
};

/// Returns the path through all bookmarks in their order, each so many seconds from the next as it
/// says; of a loop, the last step takes as long as the mean of the others. Fails, with one sentence
/// for the user, unless there are two bookmarks at least, all perspective or all orthographic.
Result<CameraPath> path_through(const Bookmarks& bookmarks, const PathChoice& choice);

}  // namespace relief

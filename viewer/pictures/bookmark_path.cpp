#include "viewer/pictures/bookmark_path.h"

namespace relief {

Result<CameraPath> path_through(const Bookmarks& bookmarks, const PathChoice& choice) {
  if (bookmarks.size() < 2) return make_error("A path needs two bookmarks: add them in Views");
  CameraPath path;
  path.frames_per_second = choice.frames_per_second;
  path.is_loop = choice.is_loop;
  double time = 0.0;
  const bool is_orthographic = bookmarks.list().front().camera.is_orthographic();
  for (const Bookmark& bookmark : bookmarks.list()) {
    if (bookmark.camera.is_orthographic() != is_orthographic)
      return make_error("{}: a path is perspective or orthographic from end to end", bookmark.name);
    path.keys.push_back({bookmark.name, time, bookmark.camera});
    time += bookmark.seconds;
  }
  return path;
}

}  // namespace relief

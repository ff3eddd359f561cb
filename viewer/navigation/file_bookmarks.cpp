#include "viewer/navigation/file_bookmarks.h"

#include <algorithm>
#include <utility>

namespace relief {

void keep_bookmarks(std::vector<FileBookmarks>& all, const std::filesystem::path& file,
                    std::vector<Bookmark> list) {
  std::erase_if(all, [&file](const FileBookmarks& one) { return one.file == file; });
  if (!list.empty()) all.insert(all.begin(), {file, std::move(list)});
  if (all.size() > kMostBookmarkedFiles) all.resize(kMostBookmarkedFiles);
}

std::vector<Bookmark> bookmarks_of(const std::vector<FileBookmarks>& all,
                                   const std::filesystem::path& file) {
  const auto found = std::ranges::find(all, file, &FileBookmarks::file);
  return found == all.end() ? std::vector<Bookmark>() : found->list;
}

}  // namespace relief

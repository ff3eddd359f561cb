// The bookmarks of files, which are there again when a file is opened again.
#pragma once

#include <filesystem>
#include <vector>

#include "viewer/navigation/bookmarks.h"

namespace relief {

inline constexpr std::size_t kMostBookmarkedFiles = 50;

/// The bookmarks of a file.
struct FileBookmarks {
  std::filesystem::path file;  ///< absolute
  std::vector<Bookmark> list;  ///< not empty

  bool operator==(const FileBookmarks&) const = default;
};

/// Puts a file's bookmarks first, in place of those that it had; an empty list takes them away.
/// Files beyond kMostBookmarkedFiles are dropped.
void keep_bookmarks(std::vector<FileBookmarks>& all, const std::filesystem::path& file,
                    std::vector<Bookmark> list);

/// Returns a file's bookmarks.
[[nodiscard]] std::vector<Bookmark> bookmarks_of(const std::vector<FileBookmarks>& all,
                                                 const std::filesystem::path& file);

}  // namespace relief

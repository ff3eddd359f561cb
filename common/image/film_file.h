// Writes films: .mp4 and .webm, by the program ffmpeg.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "common/error.h"
#include "common/image/image.h"

namespace relief {

/// Returns the file beside `path` that becomes the film once this process has finished it.
[[nodiscard]] std::filesystem::path unfinished_film(const std::filesystem::path& path);

/// Returns whether a file of this name is a film: it ends in .mp4 or .webm.
[[nodiscard]] bool is_film_name(const std::filesystem::path& path);

struct FilmOptions {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  double frames_per_second = 30.0;
};

/// A film that is being written: open, add each frame, finish. ffmpeg runs meanwhile, as another
/// process, and is stopped by the destructor unless the film is finished. The file appears when it
/// is complete, as those of AtomicFile. H.264 in .mp4, VP9 in .webm, both 4:2:0; a side of an odd
/// number of pixels gets one more, black.
class FilmFile {
 public:
  /// Fails if there is no ffmpeg.
  static Result<FilmFile> open(const std::filesystem::path& path, const FilmOptions& options);

  FilmFile(FilmFile&&) noexcept;
  FilmFile& operator=(FilmFile&&) noexcept;
  FilmFile(const FilmFile&) = delete;
  FilmFile& operator=(const FilmFile&) = delete;
  ~FilmFile();

  /// Adds a frame of the film's size: R, G, B, linear.
  Status add(const Image& frame);
  Status finish();

 private:
  struct Process;
  explicit FilmFile(std::unique_ptr<Process> process);
  Error failure();

  std::unique_ptr<Process> process_;
};

}  // namespace relief

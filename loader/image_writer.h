// Puts rendered images into files: EXR, PNG, films.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "common/error.h"
#include "common/image/film_file.h"
#include "common/image/image.h"
#include "common/legend/legend.h"
#include "common/scalars/colour_scale.h"

namespace relief {

/// Returns the file of a frame, "turn.png" with its number before the dot: "turn_0007.png".
[[nodiscard]] std::filesystem::path frame_file(const std::filesystem::path& pattern,
                                               std::size_t frame);

/// Puts images into their files, or into the film that all of them are.
class ImageWriter {
 public:
  /// `files`: of each image, in order; a film's for all. Outlives the writer. `on_complete` is
  /// called once the last of them is in its place; may be null.
  ImageWriter(const std::vector<std::filesystem::path>& files, double frames_per_second,
              std::function<void()> on_complete = {})
      : files_(files),
        frames_per_second_(frames_per_second),
        on_complete_(std::move(on_complete)) {}

  /// Writes an image and changes it: an EXR keeps the scene's light; others are exposed (stops),
  /// and get a legend of `colours`, if there are some and the image is large enough.
  Status write(std::size_t number, Image& image, double exposure,
               const std::optional<ColourScale>& colours);
  Status finish();

  /// Images in files that are complete, also after a failure. Thread-safe.
  [[nodiscard]] std::size_t written() const { return written_; }
  /// Whether some image was too small for its legend.
  [[nodiscard]] bool lacks_legend() const { return lacks_legend_; }

 private:
  const std::vector<std::filesystem::path>& files_;
  double frames_per_second_ = 0.0;
  std::function<void()> on_complete_;
  std::optional<FilmFile> film_;
  std::atomic<std::size_t> written_ = 0;
  bool lacks_legend_ = false;
  std::optional<LegendCorner> corner_;  ///< of all legends, so that they do not jump in a film
};

}  // namespace relief

#include "loader/image_writer.h"

#include <fmt/format.h>

#include <cmath>

#include "common/image/image_io.h"
#include "common/io/extension.h"

namespace relief {
namespace {

/// Multiplies light, and the background, by 2 to the power of the exposure (stops).
void expose(Image& image, double exposure) {
  const auto factor = static_cast<float>(std::exp2(exposure));
  for (Channel& channel : image.channels) {
    if (channel.name != "R" && channel.name != "G" && channel.name != "B") continue;
    for (float& value : channel.values) value *= factor;
  }
}

}  // namespace

std::filesystem::path frame_file(const std::filesystem::path& pattern, std::size_t frame) {
  std::filesystem::path name = pattern;
  return name.replace_filename(
      fmt::format("{}_{:04}{}", pattern.stem().string(), frame, pattern.extension().string()));
}

Status ImageWriter::write(std::size_t number, Image& image, double exposure,
                          const std::optional<ColourScale>& colours) {
  const std::filesystem::path& file = files_[number];
  const bool is_film = is_film_name(file);
  if (is_film && !film_) {
    const FilmOptions options{image.width, image.height, frames_per_second_};
    RELIEF_TRY_ASSIGN(film_, FilmFile::open(file, options));
  }
  const bool is_exr = lower_extension(file) == ".exr";
  if (!is_exr) {
    expose(image, exposure);
    if (colours) lacks_legend_ |= !draw_legend(*colours, image, corner_);
  }
  if (is_film) return film_->add(image);
  RELIEF_TRY(is_exr ? write_exr(file, image) : write_png(file, image));
  if (++written_ == files_.size() && on_complete_) on_complete_();
  return {};
}

Status ImageWriter::finish() {
  if (!film_) return {};
  RELIEF_TRY(film_->finish());
  if (on_complete_) on_complete_();
  return {};
}

}  // namespace relief

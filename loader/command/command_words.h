// The words of a `relief render` command: the options that stand for settings.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "common/scene/scene.h"
#include "loader/load_scene.h"

namespace relief {

/// Returns a word as a POSIX shell reads it: in single quotes unless no character needs them.
[[nodiscard]] std::string shell_word(std::string_view word);

/// Collects the words of a command, each as a POSIX shell reads it.
class CommandWords {
 public:
  void add(std::string_view word);
  /// Adds an option, named without its dashes, and its value.
  void option(std::string_view name, std::string_view value);
  /// Adds a path, such that it is not taken for an option.
  void path(const std::filesystem::path& path);
  /// Adds words that need no quotes.
  void as_is(std::string_view words);

  [[nodiscard]] std::string take() { return std::move(line_); }

 private:
  std::string line_;
};

/// Adds the options that stand for settings of a view, but for those of files: exposure, outputs.
/// Numbers have as many digits as bring them back to the bit; a background is of srgb_of().
void add_settings(const SceneSettings& options, CommandWords& words);

/// Adds the options that say how models are read, coloured and textured.
void add_reading(const LoadOptions& load, CommandWords& words);

/// Returns the names of outputs, as --outputs takes them.
[[nodiscard]] std::string names_of(const Outputs& outputs);

/// Returns the sRGB value whose light (linear_from_srgb) is a linear value, to the bit if there is
/// one.
[[nodiscard]] float srgb_of(float linear);

}  // namespace relief

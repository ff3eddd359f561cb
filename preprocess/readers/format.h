// The table of formats that can be read, and which of them a file has.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "preprocess/readers/source.h"

namespace relief {

/// A reader (see readers.h).
using Reader = Result<Points> (*)(const Source&);

/// What a file looks like inside. In a text file, bytes of value 0 are refused.
enum class FileForm : std::uint8_t { Text, Binary, Either };

/// A format of points or meshes. Detection, messages, `--help`, `--memory`, the fuzz targets and
/// their seeds all derive from its row in the table.
struct PointFormat {
  std::string_view name;  ///< in messages and help
  std::string_view
      extensions;  ///< lower case, separated by blanks; the first names the fuzz target
  /// Whether a file's first bytes, or its length, are as the format demands; null if they do not
  /// show it, so that only the extension decides.
  bool (*recognises)(std::string_view text);
  FileForm form;
  bool streams;  ///< the reader uses Source::sink, so that --memory reads the file in blocks
  Reader read;

  /// Whether a file name's extension, in lower case without the dot, is of this format.
  [[nodiscard]] bool has_extension(std::string_view extension) const;
  /// The fuzz target's name, and that of its seeds and dictionary.
  [[nodiscard]] std::string_view target() const;
};

/// Every format, in the order in which files are compared with them.
[[nodiscard]] std::span<const PointFormat> point_formats();

/// Finds the format of a file: by its content if a format recognises it, otherwise by its extension
/// (that before ".gz", if packed). Fails if no format matches; the error lists the formats that can
/// be read, or names the unsupported one.
Result<const PointFormat*> find_format(const std::filesystem::path& path, std::string_view text);

}  // namespace relief

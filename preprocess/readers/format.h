// The table of readable formats, and format detection.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "preprocess/readers/source.h"

namespace relief {

/// The type of a reader (see readers.h).
using Reader = Result<Points> (*)(const Source&);

/// The content of a format's files. Bytes of value 0 are refused in text files.
enum class FileForm : std::uint8_t { Text, Binary, Either };

/// A format of points or meshes. Detection, messages, `--help`, `--memory`, the fuzz targets and
/// their seeds all derive from its row in the table.
struct PointFormat {
  std::string_view name;  ///< in messages and help
  std::string_view
      extensions;  ///< lower case, separated by blanks; the first names the fuzz target
  /// Returns whether a file is of this format, by its first bytes or its length. Null if only the
  /// extension decides.
  bool (*recognises)(std::string_view text);
  FileForm form;
  bool streams;  ///< the reader uses Source::sink, so that --memory reads the file in blocks
  Reader read;
  bool has_classes = false;  ///< the reader uses Source::selection()

  /// Returns whether an extension, in lower case without its dot, is of this format.
  [[nodiscard]] bool has_extension(std::string_view extension) const;
  /// Returns the name of the fuzz target, its seeds and its dictionary.
  [[nodiscard]] std::string_view target() const;
};

/// Returns all formats, in the order of detection.
[[nodiscard]] std::span<const PointFormat> point_formats();

/// Finds the format of a file: by its content if a format recognises it, otherwise by its extension
/// (that before ".gz", if packed). Fails if no format matches; the error lists the formats that can
/// be read, or names the unsupported one.
/// `stated`, if not empty, names the format instead, by one of its extensions.
Result<const PointFormat*> find_format(const std::filesystem::path& path, std::string_view text,
                                       std::string_view stated = {});

/// Fails if a format without classes and returns is asked for them. `name` begins the error.
Status check_classes(const std::string& name, const PointFormat& format,
                     const PointSelection& selection);

/// Returns the format with this extension (no dot); null if there is none.
[[nodiscard]] const PointFormat* format_named(std::string_view extension);

}  // namespace relief

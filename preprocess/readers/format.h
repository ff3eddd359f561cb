// Which format a file has.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "preprocess/readers/source.h"

namespace relief {

/// A reader (see readers.h).
using Reader = Result<Points> (*)(const Source&);

/// Finds the reader for a file: by its first bytes where they tell the format, otherwise by the
/// ending of its name (".gz" left out). An error names the formats that can be read, or the one
/// that the file has and that cannot.
Result<Reader> find_reader(const std::filesystem::path& path, std::string_view text);

/// Whether a reader knows a Source's sink.
[[nodiscard]] bool reads_in_blocks(Reader reader);

}  // namespace relief

// The input of all readers of volumes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "common/error.h"
#include "common/io/mapped_file.h"
#include "common/progress.h"

namespace relief {

/// A file's bytes. They are not trusted.
struct VolumeSource {
  std::string name;  ///< path, with which each error begins
  std::span<const std::byte> bytes;
  Progress& progress;

  [[nodiscard]] std::string_view text() const {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
};

/// Opens the file that a header names as the place of its values: a path relative to the header's
/// folder that does not leave it. Fails on an absolute path, on `..` and on a file that cannot be
/// opened.
Result<MappedFile> open_beside(const VolumeSource& header, std::string_view file);

}  // namespace relief

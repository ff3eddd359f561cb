// The input of all readers of volumes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
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

/// The bytes that a header describes: what follows it, or a file of their own.
struct HeaderValues {
  std::optional<MappedFile> file;  ///< holds the bytes, if they are not the header's
  std::span<const std::byte> bytes;
};

/// Finds the values of a header that ends at `end`. `file`: that they are in, if the header names
/// one: a path relative to the header's folder that does not leave it. Fails on an absolute path,
/// on
/// `..` and on a file that cannot be opened.
Result<HeaderValues> values_of_header(const VolumeSource& header,
                                      const std::optional<std::string>& file, std::size_t end);

/// The last `count` bytes, or all if there are fewer.
[[nodiscard]] std::span<const std::byte> last_bytes(std::span<const std::byte> bytes,
                                                    std::uint64_t count);

}  // namespace relief

// Finds the only file of a zip archive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "common/error.h"

namespace relief {

/// A file in an archive, still compressed.
struct ZipEntry {
  std::span<const std::byte> bytes;
  bool is_deflated = false;    ///< raw DEFLATE; otherwise stored as it is
  std::uint32_t checksum = 0;  ///< CRC-32 of the unpacked bytes
};

/// Finds the only file, beside folders, of an archive. Believes the central directory. Fails on
/// several files, encryption, compression other than DEFLATE, parts and zip64. Errors begin with
/// `name`. Source: PKWARE's APPNOTE.TXT 6.3, sections 4.3.7, 4.3.12 and 4.3.16.
Result<ZipEntry> find_zip_entry(const std::string& name, std::span<const std::byte> archive);

}  // namespace relief

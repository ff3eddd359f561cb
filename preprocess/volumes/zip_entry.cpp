#include "preprocess/volumes/zip_entry.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "preprocess/readers/number_type.h"

namespace relief {
namespace {

constexpr std::size_t kEndBytes = 22;
constexpr std::size_t kCentralBytes = 46;
constexpr std::size_t kLocalBytes = 30;
/// The remark after the end record.
constexpr std::size_t kLongestComment = 65535;

constexpr std::string_view kEndMagic = "PK\x05\x06";
constexpr std::string_view kCentralMagic = "PK\x01\x02";
constexpr std::string_view kLocalMagic = "PK\x03\x04";

constexpr unsigned kEncrypted = 1;  ///< flag
constexpr unsigned kStored = 0;     ///< compression
constexpr unsigned kDeflated = 8;
/// A 32-bit size or offset that stands in a zip64 record.
constexpr std::uint32_t kInZip64 = 0xFFFFFFFF;

std::uint32_t word16(std::string_view text, std::size_t offset) {
  return load_whole<std::uint16_t>(text.data() + offset);
}
std::uint32_t word32(std::string_view text, std::size_t offset) {
  return load_whole<std::uint32_t>(text.data() + offset);
}

Error damaged_zip(const std::string& name, std::string_view what) {
  return make_error("{}: is not a whole zip archive ({}); unpack it, and name the file in it", name,
                    what);
}

/// The record at the end of an archive, found from behind.
std::optional<std::size_t> find_end_record(std::string_view text) {
  if (text.size() < kEndBytes) return std::nullopt;
  const std::size_t last = text.size() - kEndBytes;
  const std::size_t first = last - std::min(last, kLongestComment);
  for (std::size_t at = last + 1; at-- > first;) {
    if (text.substr(at).starts_with(kEndMagic)) return at;
  }
  return std::nullopt;
}

/// The record of the only file in the central directory.
Result<std::string_view> find_central_record(const std::string& name, std::string_view text) {
  const auto end = find_end_record(text);
  if (!end) return damaged_zip(name, "its end record is missing");
  std::size_t at = word32(text, *end + 16);
  std::string_view found;
  for (std::uint32_t left = word16(text, *end + 10); left > 0; --left) {
    if (at > text.size() || text.size() - at < kCentralBytes ||
        !text.substr(at).starts_with(kCentralMagic)) {
      return damaged_zip(name, "its directory is damaged");
    }
    const std::string_view record = text.substr(at);
    const std::size_t name_bytes = word16(record, 28);
    const std::size_t size = kCentralBytes + name_bytes + word16(record, 30) + word16(record, 32);
    if (record.size() < size) return damaged_zip(name, "its directory is damaged");
    at += size;
    if (record.substr(kCentralBytes, name_bytes).ends_with('/')) continue;
    if (!found.empty()) {
      return make_error(
          "{}: holds several files, but a volume is one; unpack it, and name the file in it", name);
    }
    found = record.substr(0, size);
  }
  if (found.empty()) return make_error("{}: holds no file", name);
  return found;
}

}  // namespace

Result<ZipEntry> find_zip_entry(const std::string& name, std::span<const std::byte> archive) {
  const std::string_view text(reinterpret_cast<const char*>(archive.data()), archive.size());
  RELIEF_TRY_ASSIGN(const auto record, find_central_record(name, text));
  const unsigned flags = word16(record, 8);
  const unsigned compression = word16(record, 10);
  const std::size_t packed_bytes = word32(record, 20);
  const std::size_t local = word32(record, 42);
  if ((flags & kEncrypted) != 0 || (compression != kStored && compression != kDeflated) ||
      packed_bytes == kInZip64 || local == kInZip64) {
    return make_error(
        "{}: its file is encrypted, larger than 4 GB or not packed by DEFLATE; unpack it, and name "
        "the file in it",
        name);
  }
  if (local > text.size() || text.size() - local < kLocalBytes ||
      !text.substr(local).starts_with(kLocalMagic)) {
    return damaged_zip(name, "its file's header is damaged");
  }
  const std::size_t begin =
      local + kLocalBytes + word16(text, local + 26) + word16(text, local + 28);
  if (begin > text.size() || text.size() - begin < packed_bytes) {
    return damaged_zip(name, "it ends within its file");
  }
  return ZipEntry{archive.subspan(begin, packed_bytes), compression == kDeflated,
                  word32(record, 16)};
}

}  // namespace relief

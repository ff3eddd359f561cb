#include "preprocess/tiles/checkpoint.h"

#include "common/io/bytes.h"
#include "common/io/file.h"
#include "common/patch_file/patch_file_layout.h"

namespace relief {

Status StateWriter::save(const std::filesystem::path& path) const {
  auto file = AtomicFile::create(path);
  if (!file) return file.error();
  std::vector<std::byte> checksum;
  append_number(checksum, crc32(bytes_));
  if (Status written = file->write(bytes_); !written) return written;
  if (Status written = file->write(checksum); !written) return written;
  return file->commit();
}

Result<StateReader> StateReader::open(const std::filesystem::path& path) {
  auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  constexpr std::size_t size = sizeof(std::uint32_t);
  if (bytes->size() < size) return wrong_state(path);
  const std::span<const std::byte> all(*bytes);
  if (ByteReader(all.last(size)).take<std::uint32_t>() != crc32(all.first(all.size() - size)))
    return wrong_state(path);
  bytes->resize(bytes->size() - size);
  return StateReader(std::move(*bytes));
}

Error wrong_state(const std::filesystem::path& path) {
  return make_error("{}: is damaged; remove the folder it is in and convert again", path.string());
}

}  // namespace relief

#include "preprocess/tiles/checkpoint.h"

#include "common/io/bytes.h"
#include "common/io/file.h"
#include "common/patch_file/patch_file_layout.h"

namespace relief {

Status CheckpointWriter::save(const std::filesystem::path& path) const {
  RELIEF_TRY_ASSIGN(auto file, AtomicFile::create(path));
  std::vector<std::byte> checksum;
  append_number(checksum, crc32(bytes_));
  RELIEF_TRY(file.write(bytes_));
  RELIEF_TRY(file.write(checksum));
  return file.commit();
}

Result<CheckpointReader> CheckpointReader::open(const std::filesystem::path& path) {
  RELIEF_TRY_ASSIGN(auto bytes, read_file(path));
  constexpr std::size_t size = sizeof(std::uint32_t);
  if (bytes.size() < size) return wrong_checkpoint(path);
  const std::span<const std::byte> all(bytes);
  if (ByteReader(all.last(size)).take<std::uint32_t>() != crc32(all.first(all.size() - size)))
    return wrong_checkpoint(path);
  bytes.resize(bytes.size() - size);
  return CheckpointReader(std::move(bytes));
}

Error wrong_checkpoint(const std::filesystem::path& path) {
  return make_error("{}: is damaged; remove the folder it is in and convert again", path.string());
}

}  // namespace relief

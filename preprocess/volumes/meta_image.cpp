#include <algorithm>

#include "preprocess/readers/gzip/inflate.h"
#include "preprocess/volumes/meta_image_header.h"
#include "preprocess/volumes/volume_readers.h"
#include "preprocess/volumes/volume_values.h"

namespace relief {
namespace {

Result<std::vector<float>> read_meta_values(const VolumeSource& data, const MetaImageHeader& header,
                                            std::uint64_t count) {
  ValueBlock block{.form = header.form, .count = count};
  std::span<const std::byte> bytes = data.bytes;
  if (header.header_size < 0) {
    const std::uint64_t size = count * size_of(header.form.type);
    if (header.is_compressed || !header.is_binary) {
      return make_error("{}: a HeaderSize of -1 is only for raw values; state how many bytes",
                        data.name);
    }
    bytes = last_bytes(bytes, size);
  } else {
    const auto skip = static_cast<std::uint64_t>(header.header_size);
    bytes = bytes.subspan(std::min<std::uint64_t>(skip, bytes.size()));
  }
  if (!header.is_binary) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return read_text_values<float>(data.name, text, count, data.progress);
  }
  // MetaIO reads both, and writes zlib.
  if (header.is_compressed) block.packing = is_gzip(bytes) ? DeflateForm::Gzip : DeflateForm::Zlib;
  return read_values<float>(data.name, bytes, block, data.progress);
}

}  // namespace

Result<ScalarVolume> read_meta_image(const VolumeSource& source) {
  RELIEF_TRY_ASSIGN(const auto header, parse_meta_image_header(source.name, source.text()));
  RELIEF_TRY_ASSIGN(auto volume, make_volume(source.name, header.size, header.grid, kLpsFrame));
  RELIEF_TRY_ASSIGN(const auto found, values_of_header(source, header.data_file, header.end));
  const VolumeSource data{source.name, found.bytes, source.progress};
  RELIEF_TRY_ASSIGN(volume.values, read_meta_values(data, header, nodes_of(volume)));
  return volume;
}

}  // namespace relief

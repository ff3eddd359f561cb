#include "preprocess/readers/source.h"
#include "preprocess/volumes/header_lines.h"
#include "preprocess/volumes/nrrd_header.h"
#include "preprocess/volumes/volume_readers.h"
#include "preprocess/volumes/volume_values.h"

namespace relief {
namespace {

/// Returns the part of a file that follows the header's `line skip`.
Result<std::span<const std::byte>> skip_nrrd_lines(const VolumeSource& data, std::int64_t lines) {
  HeaderLines skipped(data.text());
  std::string_view line;
  for (std::int64_t k = 0; k < lines; ++k) {
    if (!skipped.next(line))
      return make_error("{}: has fewer than the {} lines that are to be skipped", data.name, lines);
  }
  return data.bytes.subspan(skipped.offset());
}

Result<std::vector<float>> read_nrrd_values(const VolumeSource& data, const NrrdHeader& header,
                                            std::uint64_t count) {
  RELIEF_TRY_ASSIGN(auto bytes, skip_nrrd_lines(data, header.line_skip));
  ValueBlock block{.form = header.form, .count = count};
  if (header.byte_skip >= 0) {
    block.skip = static_cast<std::uint64_t>(header.byte_skip);
  } else if (header.encoding == NrrdEncoding::Raw) {
    const std::uint64_t size = count * size_of(header.form.type);
    bytes = last_bytes(bytes, size);
  } else {
    return make_error("{}: a byte skip of -1 is only for raw values; state how many bytes to skip",
                      data.name);
  }
  if (header.encoding == NrrdEncoding::Text) {
    const auto skip = std::min<std::uint64_t>(block.skip, bytes.size());
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return read_text_values<float>(data.name, text.substr(skip), count, data.progress);
  }
  if (header.encoding == NrrdEncoding::Gzip) block.packing = DeflateForm::Gzip;
  return read_values<float>(data.name, bytes, block, data.progress);
}

}  // namespace

Result<ScalarVolume> read_nrrd(const VolumeSource& source) {
  RELIEF_TRY_ASSIGN(const auto header, parse_nrrd_header(source.name, source.text()));
  RELIEF_TRY_ASSIGN(auto volume, make_volume(source.name, header.size, header.grid, header.frame));
  // The values' errors begin with the header's name: it is the file that the user named.
  RELIEF_TRY_ASSIGN(const auto found, values_of_header(source, header.data_file, header.end));
  const VolumeSource data{source.name, found.bytes, source.progress};
  RELIEF_TRY_ASSIGN(volume.values, read_nrrd_values(data, header, nodes_of(volume)));
  return volume;
}

}  // namespace relief

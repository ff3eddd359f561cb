#include <optional>

#include "common/io/extension.h"
#include "preprocess/volumes/volume_grid.h"
#include "preprocess/volumes/volume_readers.h"
#include "preprocess/volumes/volume_values.h"
#include "preprocess/volumes/zip_entry.h"

namespace relief {

Result<ScalarVolume> read_headerless(const VolumeSource& source, const RawLayout& layout) {
  const RegularGrid grid{glm::dvec3(0.0), scaled_axes(glm::dmat3(1.0), layout.spacing)};
  RELIEF_TRY_ASSIGN(
      auto volume,
      make_volume(source.name, {layout.size.x, layout.size.y, layout.size.z}, grid, {}));
  // A wrong layout shows by its size alone.
  ValueBlock block{.form = layout.form, .count = nodes_of(volume), .most_surplus = 0};
  std::span<const std::byte> bytes = source.bytes;
  const std::string extension = lower_extension(source.name);
  if (extension == ".zip") {
    RELIEF_TRY_ASSIGN(const auto entry, find_zip_entry(source.name, bytes));
    bytes = entry.bytes;
    if (entry.is_deflated) {
      block.packing = DeflateForm::Raw;
    }
    block.checksum = entry.checksum;
  } else if (extension == ".gz") {
    block.packing = DeflateForm::Gzip;
  }
  RELIEF_TRY_ASSIGN(volume.values, read_values<float>(source.name, bytes, block, source.progress));
  return volume;
}

}  // namespace relief

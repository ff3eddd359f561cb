#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "preprocess/readers/gzip/inflate.h"
#include "preprocess/volumes/volume_grid.h"
#include "preprocess/volumes/volume_readers.h"
#include "preprocess/volumes/volume_values.h"

namespace relief {
namespace {

/// The fields of a NIfTI-1 header, by their offsets in nifti1.h.
constexpr std::size_t kNiftiHeaderBytes = 348;
constexpr std::size_t kNiftiValuesAt = 352;
constexpr std::size_t kNiftiDim = 40;
constexpr std::size_t kNiftiDatatype = 70;
constexpr std::size_t kNiftiPixdim = 76;
constexpr std::size_t kNiftiVoxOffset = 108;
constexpr std::size_t kNiftiSlope = 112;
constexpr std::size_t kNiftiIntercept = 116;
constexpr std::size_t kNiftiQformCode = 252;
constexpr std::size_t kNiftiSformCode = 254;
constexpr std::size_t kNiftiQuaternion = 256;
constexpr std::size_t kNiftiQoffset = 268;
constexpr std::size_t kNiftiSrow = 280;
constexpr std::size_t kNiftiMagic = 344;
/// The size that begins a NIfTI-2 header.
constexpr std::int32_t kNifti2HeaderBytes = 540;

/// Reads numbers of a header in its byte order.
class NiftiHeader {
 public:
  NiftiHeader(std::span<const std::byte> bytes, bool is_big_endian)
      : bytes_(bytes), is_big_endian_(is_big_endian) {}

  [[nodiscard]] int whole(std::size_t offset) const {
    return static_cast<int>(number(NumberType::Int16, offset));
  }
  [[nodiscard]] double real(std::size_t offset) const {
    return number(NumberType::Float32, offset);
  }
  [[nodiscard]] glm::dvec3 vector(std::size_t offset) const {
    return {real(offset), real(offset + 4), real(offset + 8)};
  }
  [[nodiscard]] double number(NumberType type, std::size_t offset) const {
    const char* const at = reinterpret_cast<const char*>(bytes_.data()) + offset;
    return is_big_endian_ ? load_number<true>(type, at) : load_number<false>(type, at);
  }
  [[nodiscard]] bool is_big_endian() const { return is_big_endian_; }

 private:
  std::span<const std::byte> bytes_;
  bool is_big_endian_;
};

/// Returns the bytes of the header, unpacked if the file is gzipped.
Result<std::vector<std::byte>> nifti_header_bytes(const VolumeSource& source) {
  std::vector<std::byte> header;
  const auto take = [&](std::span<const std::byte> piece, std::size_t) -> Result<bool> {
    const std::size_t wanted = kNiftiHeaderBytes - header.size();
    const auto part = piece.first(std::min(wanted, piece.size()));
    header.insert(header.end(), part.begin(), part.end());
    return header.size() < kNiftiHeaderBytes;
  };
  if (is_gzip(source.bytes)) {
    RELIEF_TRY(inflate_pieces(source.name, source.bytes, DeflateForm::Gzip, source.progress, take));
  } else {
    RELIEF_TRY(take(source.bytes, 0));
  }
  if (header.size() == kNiftiHeaderBytes) return header;
  return make_error("{}: holds {} bytes, but a NIfTI-1 header has {}; the file is truncated",
                    source.name, header.size(), kNiftiHeaderBytes);
}

/// Finds the byte order of a header and checks what begins and ends it.
Result<NiftiHeader> check_nifti_header(const std::string& name, std::span<const std::byte> bytes) {
  for (const bool big : {false, true}) {
    const NiftiHeader header(bytes, big);
    const double size = header.number(NumberType::Int32, 0);
    if (size == kNifti2HeaderBytes) {
      return make_error("{}: is NIfTI-2, which cannot be read; save it as NIfTI-1", name);
    }
    if (size != static_cast<double>(kNiftiHeaderBytes)) continue;
    const std::string_view magic(reinterpret_cast<const char*>(bytes.data()) + kNiftiMagic, 4);
    if (magic.starts_with("n+1")) return header;
    if (magic.starts_with("ni1")) {
      return make_error(
          "{}: is the header of a pair of NIfTI files (.hdr and .img), which cannot be read; save "
          "them as one .nii",
          name);
    }
    return make_error(
        "{}: lacks the letters n+1 at byte {}, so it is Analyze or damaged, not NIfTI-1; save it "
        "as NIfTI-1",
        name, kNiftiMagic);
  }
  return make_error("{}: does not begin with the number 348, as NIfTI-1 files do", name);
}

Result<NumberType> nifti_type(const std::string& name, int code) {
  switch (code) {
    case 2:
      return NumberType::Uint8;
    case 4:
      return NumberType::Int16;
    case 8:
      return NumberType::Int32;
    case 16:
      return NumberType::Float32;
    case 64:
      return NumberType::Float64;
    case 256:
      return NumberType::Int8;
    case 512:
      return NumberType::Uint16;
    case 768:
      return NumberType::Uint32;
    case 1024:
      return NumberType::Int64;
    case 1280:
      return NumberType::Uint64;
    default:
      return make_error(
          "{}: its values are of NIfTI's type {}, which is not one real number a voxel (as colours "
          "and complex numbers are not); extract one component",
          name, code);
  }
}

Result<std::array<std::int64_t, 3>> nifti_size(const std::string& name, const NiftiHeader& header) {
  const int dimensions = header.whole(kNiftiDim);
  if (dimensions < 3 || dimensions > 7) {
    return make_error("{}: has {} dimensions, but a volume has 3; correct the header", name,
                      dimensions);
  }
  std::array<std::int64_t, 3> size{};
  for (std::size_t d = 1; d <= static_cast<std::size_t>(dimensions); ++d) {
    const int nodes = header.whole(kNiftiDim + 2 * d);
    if (d <= 3) {
      size[d - 1] = nodes;
    } else if (nodes != 1) {
      return make_error(
          "{}: has a size of {} along dimension {} (time or components), but only one volume can "
          "be read; extract one",
          name, nodes, d);
    }
  }
  return size;
}

/// Spacing along the three axes; the two ways of placement that use it need it above 0.
Result<glm::dvec3> nifti_spacing(const std::string& name, const NiftiHeader& header) {
  const glm::dvec3 spacing = header.vector(kNiftiPixdim + 4);
  if (spacing.x > 0.0 && spacing.y > 0.0 && spacing.z > 0.0) return spacing;
  return make_error("{}: its spacing (pixdim) is {} x {} x {}; each must be above 0", name,
                    spacing.x, spacing.y, spacing.z);
}

/// The rotation that the header states by three parts of a unit quaternion (method 2 of nifti1.h).
Result<RegularGrid> nifti_qform(const std::string& name, const NiftiHeader& header) {
  RELIEF_TRY_ASSIGN(glm::dvec3 spacing, nifti_spacing(name, header));
  const glm::dvec3 part = header.vector(kNiftiQuaternion);
  const double rest = 1.0 - glm::dot(part, part);
  // Below zero by rounding: parts of a half turn are written as floats.
  if (!(rest > -1e-5)) {
    return make_error(
        "{}: its rotation (quatern_b, c, d) is ({}, {}, {}), which is longer than 1; correct the "
        "header",
        name, part.x, part.y, part.z);
  }
  const glm::dquat rotation(std::sqrt(std::max(rest, 0.0)), part.x, part.y, part.z);
  if (header.real(kNiftiPixdim) < 0.0) spacing.z = -spacing.z;
  return RegularGrid{header.vector(kNiftiQoffset),
                     scaled_axes(glm::mat3_cast(glm::normalize(rotation)), spacing)};
}

/// The rows of an affine matrix (method 3 of nifti1.h).
RegularGrid nifti_sform(const NiftiHeader& header) {
  RegularGrid grid;
  for (glm::length_t row = 0; row < 3; ++row) {
    const std::size_t at = kNiftiSrow + 16 * static_cast<std::size_t>(row);
    const glm::dvec3 part = header.vector(at);
    for (glm::length_t axis = 0; axis < 3; ++axis) grid.step[axis][row] = part[axis];
    grid.origin[row] = header.real(at + 12);
  }
  return grid;
}

Result<ScalarVolume> place_nifti(const std::string& name, const NiftiHeader& header) {
  RELIEF_TRY_ASSIGN(const auto size, nifti_size(name, header));
  if (header.whole(kNiftiSformCode) > 0) {
    return make_volume(name, size, nifti_sform(header), kRasFrame);
  }
  if (header.whole(kNiftiQformCode) > 0) {
    RELIEF_TRY_ASSIGN(const auto grid, nifti_qform(name, header));
    return make_volume(name, size, grid, kRasFrame);
  }
  RELIEF_TRY_ASSIGN(const auto spacing, nifti_spacing(name, header));
  return make_volume(name, size, {glm::dvec3(0.0), scaled_axes(glm::dmat3(1.0), spacing)}, {});
}

/// Where the values begin, bytes.
Result<std::uint64_t> nifti_values_at(const std::string& name, const NiftiHeader& header) {
  const double offset = header.real(kNiftiVoxOffset);
  if (offset == 0.0) return kNiftiValuesAt;
  // A float is exact up to 2^24.
  if (offset >= kNiftiHeaderBytes && offset <= 0x1p24 && offset == std::floor(offset)) {
    return static_cast<std::uint64_t>(offset);
  }
  return make_error("{}: its values begin at byte {} (vox_offset), which cannot be; correct it",
                    name, offset);
}

/// Applies the scale that the header states. Programs write NaN or 0 for none.
void scale_nifti(const NiftiHeader& header, std::vector<float>& values) {
  const double slope = header.real(kNiftiSlope);
  const double stated = header.real(kNiftiIntercept);
  if (slope == 0.0 || !std::isfinite(slope)) return;
  const double intercept = std::isfinite(stated) ? stated : 0.0;
  if (slope == 1.0 && intercept == 0.0) return;
  for (float& value : values) value = value_or_nan(slope * value + intercept);
}

}  // namespace

Result<ScalarVolume> read_nifti(const VolumeSource& source) {
  RELIEF_TRY_ASSIGN(const auto bytes, nifti_header_bytes(source));
  RELIEF_TRY_ASSIGN(const auto header, check_nifti_header(source.name, bytes));
  RELIEF_TRY_ASSIGN(const auto type, nifti_type(source.name, header.whole(kNiftiDatatype)));
  RELIEF_TRY_ASSIGN(auto volume, place_nifti(source.name, header));
  RELIEF_TRY_ASSIGN(const auto values_at, nifti_values_at(source.name, header));
  ValueBlock block{
      .form = {type, header.is_big_endian()}, .count = nodes_of(volume), .skip = values_at};
  if (is_gzip(source.bytes)) block.packing = DeflateForm::Gzip;
  RELIEF_TRY_ASSIGN(volume.values,
                    read_values<float>(source.name, source.bytes, block, source.progress));
  scale_nifti(header, volume.values);
  return volume;
}

}  // namespace relief

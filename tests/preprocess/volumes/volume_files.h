// One small volume in each format, made for the tests.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "preprocess/volumes/read_volume.h"
#include "tests/preprocess/readers/gltf_files.h"
#include "tests/preprocess/readers/pack.h"
#include "tests/preprocess/readers/scan_files.h"

namespace relief::test {

/// What read_volume would make of a file with this name and these bytes; nothing is written.
inline Result<ScalarVolume> try_volume(const std::string& name, std::string_view bytes,
                                       std::string_view layout = {}) {
  Progress progress;
  VolumeReadOptions options;
  if (!layout.empty()) {
    auto parsed = parse_raw_layout(layout);
    if (!parsed) return parsed.error();
    options.raw = *parsed;
  }
  return read_volume_bytes(name, std::as_bytes(std::span(bytes)), options, progress);
}

/// A file that must be readable.
inline ScalarVolume volume_of(const std::string& name, std::string_view bytes,
                              std::string_view layout = {}) {
  auto volume = try_volume(name, bytes, layout);
  if (!volume) {
    ADD_FAILURE() << volume.error().message;
    return {};
  }
  return *std::move(volume);
}

/// The error, without the file's name, of a file that must not be readable.
inline std::string volume_error(const std::string& name, std::string_view bytes,
                                std::string_view layout = {}) {
  const auto volume = try_volume(name, bytes, layout);
  if (volume) return "no error";
  const std::string& message = volume.error().message;
  EXPECT_TRUE(message.starts_with(name + ": ")) << message;
  return message.substr(std::min(name.size() + 2, message.size()));
}

/// The world position of a node.
inline glm::dvec3 node_position(const ScalarVolume& volume, glm::uvec3 node) {
  if (const auto* regular = std::get_if<RegularGrid>(&volume.placement))
    return regular->origin + regular->step * glm::dvec3(node);
  if (const auto* grid = std::get_if<RectilinearGrid>(&volume.placement)) {
    return grid->origin + grid->axes * glm::dvec3(grid->coordinates[0][node.x],
                                                  grid->coordinates[1][node.y],
                                                  grid->coordinates[2][node.z]);
  }
  return std::get<CurvilinearGrid>(volume.placement)
      .positions[node.x + volume.size.x * (node.y + std::size_t{volume.size.y} * node.z)];
}

/// One zlib stream.
inline std::string zlib_pack(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  EXPECT_EQ(compress(reinterpret_cast<Bytef*>(out.data()), &size,
                     reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()),
            Z_OK);
  out.resize(size);
  return out;
}

/// A zip archive with one file.
inline std::string zip(std::string_view bytes, bool deflated = true) {
  std::string packed(bytes);
  if (deflated) {
    packed = zlib_pack(bytes);
    packed = packed.substr(2, packed.size() - 6);  // without zlib's header and checksum
  }
  const auto checksum = static_cast<std::uint32_t>(
      ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
  const auto size = static_cast<std::uint32_t>(bytes.size());
  const auto packed_size = static_cast<std::uint32_t>(packed.size());
  const std::uint16_t method = deflated ? 8 : 0;
  const std::uint16_t none = 0;
  const std::string common = pack(std::uint16_t{20}, none, method, none, none, checksum,
                                  packed_size, size, std::uint16_t{1}, none);
  const std::string local = "PK\x03\x04" + common + "a" + packed;
  const std::string central = "PK\x01\x02" + pack(std::uint16_t{20}) + common +
                              pack(none, none, none, std::uint32_t{0}, std::uint32_t{0}) + "a";
  return local + central + "PK\x05\x06" +
         pack(none, none, std::uint16_t{1}, std::uint16_t{1},
              static_cast<std::uint32_t>(central.size()), static_cast<std::uint32_t>(local.size()),
              none);
}

// The volume of all formats: 2 x 3 x 4 nodes, no two of the same value, and no axis along its own
// in the world, so that a swap or a mirror shows. i runs along +Y, j along -X, k along +Z.

inline constexpr glm::uvec3 kSampleSize{2, 3, 4};
/// Right-anterior-superior.
inline const RegularGrid kSampleGrid{
    {10.0, -20.0, 30.0}, {glm::dvec3(0, 1.5, 0), glm::dvec3(-2, 0, 0), glm::dvec3(0, 0, 3)}};

inline int sample_value(glm::uvec3 node) {
  return static_cast<int>(1 + node.x + 10 * node.y + 30 * node.z);
}

/// Calls `visit` for each node, in the order of files.
template <class Visit>
void for_each_node(glm::uvec3 size, const Visit& visit) {
  for (glm::uvec3 node(0); node.z < size.z; ++node.z) {
    for (node.y = 0; node.y < size.y; ++node.y) {
      for (node.x = 0; node.x < size.x; ++node.x) visit(node);
    }
  }
}

template <class Number>
std::string sample_bytes(ByteOrder order = ByteOrder::Little) {
  std::string bytes;
  for_each_node(kSampleSize, [&](glm::uvec3 node) {
    bytes += pack(order, static_cast<Number>(sample_value(node)));
  });
  return bytes;
}

inline std::string sample_text() {
  std::string text;
  for_each_node(kSampleSize,
                [&](glm::uvec3 node) { text += fmt::format("{}\n", sample_value(node)); });
  return text;
}

/// A header for the sample, left-posterior-superior; `more` are further lines.
inline std::string nrrd_header(std::string_view type, std::string_view encoding,
                               std::string_view more = "endian: little\n") {
  return fmt::format(
      "NRRD0004\n# made here\ntype: {}\ndimension: 3\nspace: left-posterior-superior\n"
      "sizes: 2 3 4\nspace directions: (0,-1.5,0) (2,0,0) (0,0,3)\nkinds: domain domain domain\n"
      "encoding: {}\nspace origin: (-10,20,30)\nremark:=none\n{}",
      type, encoding, more);
}

/// The fields of a NIfTI-1 header that the tests vary; the defaults are those of the sample.
struct NiftiFile {
  ByteOrder order = ByteOrder::Little;
  std::int16_t datatype = 4;
  std::vector<std::int16_t> dim = {3, 2, 3, 4};
  std::vector<float> pixdim = {1.F, 1.5F, 2.F, 3.F};
  float slope = 0.F;
  float intercept = 0.F;
  std::int16_t qform_code = 0;
  std::int16_t sform_code = 1;
  std::vector<float> quatern = {0.F, 0.F, 0.F};
  std::vector<float> srow = {0, -2, 0, 10, 1.5, 0, 0, -20, 0, 0, 3, 30};
  float vox_offset = 352.F;
  std::string magic = "n+1";
};

inline std::string nifti_file(const NiftiFile& file, const std::string& values) {
  std::string header(352, '\0');
  const auto put = [&](std::size_t at, auto number) {
    const std::string bytes = pack(file.order, number);
    header.replace(at, bytes.size(), bytes);
  };
  put(0, std::int32_t{348});
  for (std::size_t k = 0; k < file.dim.size(); ++k) put(40 + 2 * k, file.dim[k]);
  put(70, file.datatype);
  for (std::size_t k = 0; k < file.pixdim.size(); ++k) put(76 + 4 * k, file.pixdim[k]);
  put(108, file.vox_offset);
  put(112, file.slope);
  put(116, file.intercept);
  put(252, file.qform_code);
  put(254, file.sform_code);
  for (std::size_t k = 0; k < 3; ++k) put(256 + 4 * k, file.quatern[k]);
  const float offset[] = {10.F, -20.F, 30.F};
  for (std::size_t k = 0; k < 3; ++k) put(268 + 4 * k, offset[k]);
  for (std::size_t k = 0; k < 12; ++k) put(280 + 4 * k, file.srow[k]);
  header.replace(344, file.magic.size(), file.magic);
  return header + values;
}

/// A header for the sample; `more` are further lines, the last of which is ElementDataFile.
inline std::string meta_header(std::string_view type, std::string_view more) {
  return fmt::format(
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nTransformMatrix = 0 -1 0 1 0 0 0 0 1\n"
      "Offset = -10 20 30\nElementSpacing = 1.5 2 3\nDimSize = 2 3 4\nElementType = {}\n{}",
      type, more);
}

/// How a VTK file's arrays are written.
struct VtkForm {
  enum class Data { Ascii, Base64, AppendedRaw, AppendedBase64 };
  Data data = Data::Ascii;
  bool is_packed = false;
  bool has_wide_sizes = false;
  ByteOrder order = ByteOrder::Little;
};

/// Writes a VTK file array by array.
class VtkWriter {
 public:
  explicit VtkWriter(VtkForm form) : form_(form) {}

  /// A DataArray with these numbers, without its closing `>` of attributes beyond `attributes`.
  template <class Number>
  std::string array(std::string_view type, std::string_view attributes,
                    const std::vector<Number>& numbers) {
    std::string bytes;
    std::string text;
    for (const Number number : numbers) {
      bytes += pack(form_.order, number);
      text += fmt::format("{} ", number);
    }
    const bool is_appended = form_.data >= VtkForm::Data::AppendedRaw;
    const std::string start = fmt::format("<DataArray type=\"{}\" {} ", type, attributes);
    if (form_.data == VtkForm::Data::Ascii)
      return start + "format=\"ascii\">\n" + text + "\n</DataArray>\n";
    const bool is_base64 = form_.data != VtkForm::Data::AppendedRaw;
    const std::string encoded = encode(bytes, is_base64);
    if (!is_appended) return start + "format=\"binary\">\n" + encoded + "\n</DataArray>\n";
    const std::size_t offset = appended_.size();
    appended_ += encoded;
    return start + fmt::format("format=\"appended\" offset=\"{}\"/>\n", offset);
  }

  /// The whole file, around a grid's element.
  [[nodiscard]] std::string file(std::string_view kind, std::string_view grid) const {
    std::string text = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"{}\" "
        "header_type=\"{}\"{}>\n{}",
        kind, form_.order == ByteOrder::Little ? "LittleEndian" : "BigEndian",
        form_.has_wide_sizes ? "UInt64" : "UInt32",
        form_.is_packed ? " compressor=\"vtkZLibDataCompressor\"" : "", grid);
    if (form_.data >= VtkForm::Data::AppendedRaw) {
      text += fmt::format("<AppendedData encoding=\"{}\">\n_{}\n</AppendedData>\n",
                          form_.data == VtkForm::Data::AppendedRaw ? "raw" : "base64", appended_);
    }
    return text + "</VTKFile>\n";
  }

 private:
  [[nodiscard]] std::string size(std::size_t value) const {
    return form_.has_wide_sizes ? pack(form_.order, std::uint64_t{value})
                                : pack(form_.order, static_cast<std::uint32_t>(value));
  }
  /// Packed in two blocks, so that a number may lie on their border.
  [[nodiscard]] std::string encode(const std::string& bytes, bool is_base64) const {
    const auto coded = [&](const std::string& b) -> std::string {
      return is_base64 ? base64(b) : b;
    };
    if (!form_.is_packed) return coded(size(bytes.size()) + bytes);
    const std::size_t block = bytes.size() / 2 + 1;
    const std::string first = zlib_pack(bytes.substr(0, block));
    const std::string second = zlib_pack(bytes.substr(block));
    return coded(size(2) + size(block) + size(bytes.size() - block) + size(first.size()) +
                 size(second.size())) +
           coded(first + second);
  }

  VtkForm form_;
  std::string appended_;
};

/// The sample's values, in the order of files.
template <class Number>
std::vector<Number> sample_numbers() {
  std::vector<Number> numbers;
  for_each_node(kSampleSize, [&](glm::uvec3 node) {
    numbers.push_back(static_cast<Number>(sample_value(node)));
  });
  return numbers;
}

/// The sample as image data; `before` stands before the array of values.
template <class Number = std::int16_t>
std::string vti_file(const VtkForm& form, std::string_view type = "Int16",
                     std::string_view before = {}) {
  VtkWriter writer(form);
  return writer.file(
      "ImageData",
      fmt::format("<ImageData WholeExtent=\"4 5 0 2 0 3\" Origin=\"10 -26 30\" "
                  "Spacing=\"1.5 2 3\" Direction=\"0 -1 0 1 0 0 0 0 1\">\n"
                  "<Piece Extent=\"4 5 0 2 0 3\">\n<PointData Scalars=\"density\">\n{}{}"
                  "</PointData></Piece></ImageData>\n",
                  before, writer.array(type, "Name=\"density\"", sample_numbers<Number>())));
}

/// The sample as a structured grid.
inline std::string vts_file(const VtkForm& form) {
  std::vector<double> points;
  for_each_node(kSampleSize, [&](glm::uvec3 node) {
    const glm::dvec3 p = kSampleGrid.origin + kSampleGrid.step * glm::dvec3(node);
    points.insert(points.end(), {p.x, p.y, p.z});
  });
  VtkWriter writer(form);
  const std::string values = writer.array("Float32", "Name=\"density\"", sample_numbers<float>());
  return writer.file("StructuredGrid",
                     "<StructuredGrid WholeExtent=\"0 1 0 2 0 3\"><Piece Extent=\"0 1 0 2 0 3\">"
                     "<PointData>" +
                         values + "</PointData><Points>" +
                         writer.array("Float64", "NumberOfComponents=\"3\"", points) +
                         "</Points></Piece></StructuredGrid>");
}

/// A rectilinear grid with the sample's values; y falls.
inline std::string vtr_file(const VtkForm& form) {
  VtkWriter writer(form);
  const std::string values =
      writer.array("UInt8", "Name=\"density\"", sample_numbers<std::uint8_t>());
  return writer.file("RectilinearGrid",
                     "<RectilinearGrid WholeExtent=\"0 1 0 2 0 3\"><Piece Extent=\"0 1 0 2 0 3\">"
                     "<PointData>" +
                         values + "</PointData><Coordinates>" +
                         writer.array<float>("Float32", "Name=\"x\"", {1.F, 2.5F}) +
                         writer.array<float>("Float32", "Name=\"y\"", {6.F, 5.F, 1.F}) +
                         writer.array<double>("Float64", "Name=\"z\"", {0.0, 1.0, 4.0, 9.0}) +
                         "</Coordinates></Piece></RectilinearGrid>");
}

/// The sample in one format.
struct VolumeFile {
  std::string name;
  std::string bytes;
  bool is_anatomical = false;
  std::string layout = {};  ///< of files without a header
};

/// The sample in every format that can hold its frame.
inline std::vector<VolumeFile> volume_files() {
  const std::string i16 = sample_bytes<std::int16_t>();
  NiftiFile turned{.qform_code = 1, .sform_code = 0};
  turned.quatern = {0.F, 0.F, std::sqrt(0.5F)};
  using Data = VtkForm::Data;
  return {
      {"raw.nrrd", nrrd_header("short", "raw") + "\n" + i16, true},
      {"gzip.nrrd", nrrd_header("short", "gzip") + "\n" + gzip(i16), true},
      {"ascii.nrrd", nrrd_header("uchar", "ascii", "") + "\n" + sample_text(), true},
      {"sform.nii", nifti_file({}, i16), true},
      {"qform.nii", nifti_file(turned, i16), true},
      {"gzip.nii.gz", gzip(nifti_file({}, i16)), true},
      {"raw.mha", meta_header("MET_SHORT", "ElementDataFile = LOCAL\n") + i16, true},
      {"zlib.mha",
       meta_header("MET_SHORT", "CompressedData = True\nElementDataFile = LOCAL\n") +
           zlib_pack(i16),
       true},
      {"gzip.mha",
       meta_header("MET_SHORT", "CompressedData = True\nElementDataFile = LOCAL\n") + gzip(i16),
       true},
      {"ascii.mha",
       meta_header("MET_FLOAT", "BinaryData = False\nElementDataFile = LOCAL\n") + sample_text(),
       true},
      {"ascii.vti", vti_file({})},
      {"base64.vti", vti_file({.data = Data::Base64})},
      {"packed.vti", vti_file({.data = Data::Base64, .is_packed = true})},
      {"raw.vti", vti_file({.data = Data::AppendedRaw})},
      {"packed_raw.vti",
       vti_file({.data = Data::AppendedRaw, .is_packed = true, .has_wide_sizes = true})},
      {"appended.vti", vti_file({.data = Data::AppendedBase64, .order = ByteOrder::Big})},
      {"packed_appended.vti", vti_file({.data = Data::AppendedBase64, .is_packed = true})},
      {"ascii.vts", vts_file({})},
      {"raw.vts", vts_file({.data = Data::AppendedRaw, .is_packed = true})},
  };
}

/// Files whose frame is not the sample's.
inline std::vector<VolumeFile> plain_volume_files() {
  const std::string i16 = sample_bytes<std::int16_t>(ByteOrder::Big);
  return {
      {"values.raw", i16, false, "2x3x4:i16:be"},
      {"values.raw.gz", gzip(i16), false, "2x3x4:i16:be:1,2,3"},
      {"deflated.zip", zip(i16), false, "2x3x4:i16:be"},
      {"stored.zip", zip(i16, false), false, "2x3x4:i16:be"},
      {"ascii.vtr", vtr_file({})},
      {"base64.vtr", vtr_file({.data = VtkForm::Data::Base64, .is_packed = true})},
  };
}

}  // namespace relief::test

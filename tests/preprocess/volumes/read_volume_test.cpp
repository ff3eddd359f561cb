// The same volume in all formats: values stay where they are in the world.
#include "preprocess/volumes/read_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/common/patch_file/sample_models.h"
#include "tests/preprocess/volumes/volume_files.h"

namespace relief::test {
namespace {

constexpr Stance kFacing{{0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, false};

void expect_sample_values(const ScalarVolume& volume, const std::string& name) {
  ASSERT_EQ(volume.size, kSampleSize) << name;
  ASSERT_EQ(volume.values.size(), nodes_of(volume)) << name;
  std::size_t at = 0;
  for_each_node(kSampleSize, [&](glm::uvec3 node) {
    EXPECT_EQ(volume.values[at++], static_cast<float>(sample_value(node))) << name;
  });
}

void expect_sample_places(const ScalarVolume& volume, const std::string& name) {
  for_each_node(kSampleSize, [&](glm::uvec3 node) {
    const glm::dvec3 wanted = kSampleGrid.origin + kSampleGrid.step * glm::dvec3(node);
    // The quaternion of a NIfTI file is written as floats, with steps of 6e-8.
    EXPECT_LT(glm::distance(node_position(volume, node), wanted), 1e-5) << name;
  });
}

TEST(ReadVolumeTest, EveryFormatGivesTheSameValuesAtTheSamePlaces) {
  for (const VolumeFile& file : volume_files()) {
    const ScalarVolume volume = volume_of(file.name, file.bytes);
    expect_sample_values(volume, file.name);
    expect_sample_places(volume, file.name);
    EXPECT_EQ(volume.stance, file.is_anatomical ? kFacing : kZUp) << file.name;
  }
  for (const VolumeFile& file : plain_volume_files()) {
    const ScalarVolume volume = volume_of(file.name, file.bytes, file.layout);
    expect_sample_values(volume, file.name);
    EXPECT_EQ(volume.stance, kZUp) << file.name;
  }
}

TEST(ReadVolumeTest, DetachedValuesAreReadBesideTheHeader) {
  const ScratchFolder scratch;
  const std::string i16 = sample_bytes<std::int16_t>();
  spill(scratch / "a.raw", i16);
  spill(scratch / "a.raw.gz", gzip(i16));
  spill(scratch / "a.zraw", zlib_pack(i16));
  spill(scratch / "remarks.raw", "one\ntwo\nabc" + i16);
  spill(scratch / "raw.nhdr", nrrd_header("short", "raw", "endian: little\ndata file: a.raw\n"));
  spill(scratch / "gzip.nhdr",
        nrrd_header("short", "gzip", "endian: little\ndatafile: a.raw.gz\n\n"));
  spill(scratch / "skips.nhdr",
        nrrd_header("short", "raw",
                    "endian: little\nline skip: 2\nbyte skip: 3\ndata file: remarks.raw\n"));
  spill(scratch / "end.nhdr",
        nrrd_header("short", "raw", "endian: little\nbyte skip: -1\ndata file: remarks.raw\n"));
  spill(scratch / "raw.mhd", meta_header("MET_SHORT", "ElementDataFile = a.raw\n"));
  spill(scratch / "zlib.mhd",
        meta_header("MET_SHORT", "CompressedData = True\nElementDataFile = a.zraw\n"));
  spill(scratch / "end.mhd",
        meta_header("MET_SHORT", "HeaderSize = -1\nElementDataFile = remarks.raw\n"));
  spill(scratch / "skip.mhd",
        meta_header("MET_SHORT", "HeaderSize = 11\nElementDataFile = remarks.raw\n"));
  for (const char* name : {"raw.nhdr", "gzip.nhdr", "skips.nhdr", "end.nhdr", "raw.mhd", "zlib.mhd",
                           "end.mhd", "skip.mhd"}) {
    Progress progress;
    const auto volume = read_volume(scratch / name, {}, progress);
    ASSERT_TRUE(volume) << volume.error().message;
    expect_sample_values(*volume, name);
    expect_sample_places(*volume, name);
  }
}

TEST(ReadVolumeTest, DetachedValuesOutsideTheFolderAreRefused) {
  for (const char* file : {"/etc/passwd", "../a.raw", "a/../../b.raw", "a/.."}) {
    const std::string nrrd =
        nrrd_header("short", "raw", fmt::format("endian: little\ndata file: {}\n", file));
    const std::string expected = fmt::format(
        "names '{}' as the file of its values, which is outside the header's folder; put both into "
        "one folder and name the file without a path",
        file);
    EXPECT_EQ(volume_error("a.nhdr", nrrd), expected);
    EXPECT_EQ(volume_error("a.mhd",
                           meta_header("MET_SHORT", fmt::format("ElementDataFile = {}\n", file))),
              expected);
  }
  EXPECT_EQ(volume_error("nowhere/a.mhd", meta_header("MET_SHORT", "ElementDataFile = a.raw\n")),
            "the file of its values: nowhere/a.raw: cannot be opened: no such file or directory");
}

TEST(ReadVolumeTest, RectilinearCoordinatesAscendAndPointsStay) {
  for (const VolumeFile& file : plain_volume_files()) {
    if (!file.name.ends_with(".vtr")) continue;
    const ScalarVolume volume = volume_of(file.name, file.bytes);
    const auto* const grid = std::get_if<RectilinearGrid>(&volume.placement);
    ASSERT_NE(grid, nullptr);
    EXPECT_EQ(grid->coordinates[1], (std::vector<double>{-6.0, -5.0, -1.0}));
    EXPECT_EQ(node_position(volume, {1, 0, 3}), glm::dvec3(2.5, 6.0, 9.0));
    EXPECT_EQ(node_position(volume, {0, 2, 2}), glm::dvec3(1.0, 1.0, 4.0));
  }
}

TEST(ReadVolumeTest, SpacesOfNrrdBecomeRightAnteriorSuperior) {
  const auto first_step = [](std::string_view space) {
    std::string file = nrrd_header("short", "raw") + "\n" + sample_bytes<std::int16_t>();
    const std::string line = "space: left-posterior-superior\n";
    file.replace(file.find(line), line.size(), space);
    const ScalarVolume volume = volume_of("a.nrrd", file);
    EXPECT_EQ(volume.stance == kFacing, !space.empty() && !space.starts_with("space: 3D") &&
                                            !space.starts_with("space: scanner"));
    const auto& grid = std::get<RegularGrid>(volume.placement);
    return std::pair(grid.origin, grid.step[0] + grid.step[1]);
  };
  using Pair = std::pair<glm::dvec3, glm::dvec3>;
  // The header says: origin (-10, 20, 30), steps (0, -1.5, 0) and (2, 0, 0).
  EXPECT_EQ(first_step("space: LPS\n"), Pair({10, -20, 30}, {-2, 1.5, 0}));
  EXPECT_EQ(first_step("space: right-anterior-superior\n"), Pair({-10, 20, 30}, {2, -1.5, 0}));
  EXPECT_EQ(first_step("space: left-anterior-superior\n"), Pair({10, 20, 30}, {-2, -1.5, 0}));
  EXPECT_EQ(first_step("space: scanner-xyz\n"), Pair({-10, 20, 30}, {2, -1.5, 0}));
  EXPECT_EQ(first_step("space: 3D-left-handed\n"), Pair({10, 20, 30}, {-2, -1.5, 0}));
  EXPECT_EQ(first_step(""), Pair({-10, 20, 30}, {2, -1.5, 0}));
}

TEST(ReadVolumeTest, SpacingsAloneMakeAGrid) {
  const ScalarVolume volume =
      volume_of("a.nrrd",
                "NRRD0001\ntype: uint8\ndimension: 3\nsizes: 2 3 4\nspacings: 1 2.5 3\n"
                "encoding: txt\n\n" +
                    sample_text());
  expect_sample_values(volume, "a.nrrd");
  EXPECT_EQ(node_position(volume, {1, 1, 1}), glm::dvec3(1.0, 2.5, 3.0));
  EXPECT_EQ(volume.stance, kZUp);
  const ScalarVolume raw = volume_of("a.bin", sample_bytes<float>(), "2x3x4:f32:1,2.5,3");
  EXPECT_EQ(node_position(raw, {1, 1, 1}), glm::dvec3(1.0, 2.5, 3.0));
}

TEST(ReadVolumeTest, NiftiIsPlacedBySformThenQformThenSpacing) {
  const std::string i16 = sample_bytes<std::int16_t>();
  const auto corner = [&](const NiftiFile& file) {
    const ScalarVolume volume = volume_of("a.nii", nifti_file(file, i16));
    return std::pair(node_position(volume, {1, 2, 3}), volume.stance == kFacing);
  };
  using Pair = std::pair<glm::dvec3, bool>;
  EXPECT_EQ(corner({.qform_code = 1, .sform_code = 2}), Pair({6.0, -18.5, 39.0}, true));
  // The quaternion is that of no rotation.
  EXPECT_EQ(corner({.qform_code = 1, .sform_code = 0}), Pair({11.5, -16.0, 39.0}, true));
  // qfac of -1 turns k.
  NiftiFile turned{.qform_code = 1, .sform_code = 0};
  turned.pixdim[0] = -1.F;
  EXPECT_EQ(corner(turned), Pair({11.5, -16.0, 21.0}, true));
  EXPECT_EQ(corner({.sform_code = 0}), Pair({1.5, 4.0, 9.0}, false));
}

TEST(ReadVolumeTest, NiftiScalesItsValues) {
  const std::string i16 = sample_bytes<std::int16_t>();
  const auto second = [&](float slope, float intercept) {
    const NiftiFile file{.slope = slope, .intercept = intercept};
    return volume_of("a.nii", nifti_file(file, i16)).values[1];
  };
  EXPECT_EQ(second(0.5F, -3.F), -2.F);
  EXPECT_EQ(second(0.F, 7.F), 2.F);  // as nifti1.h has it: a slope of 0 is none
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(second(nan, nan), 2.F);
}

TEST(ReadVolumeTest, NiftiMayStateFurtherDimensionsOfOne) {
  const std::string i16 = sample_bytes<std::int16_t>();
  expect_sample_values(volume_of("a.nii", nifti_file({.dim = {5, 2, 3, 4, 1, 1}}, i16)), "5");
  EXPECT_EQ(volume_error("a.nii", nifti_file({.dim = {4, 2, 3, 4, 7}}, i16)),
            "has a size of 7 along dimension 4 (time or components), but only one volume can be "
            "read; extract one");
}

/// The smallest, the largest and 22 other numbers of a type.
template <class Number>
std::vector<Number> extreme_numbers() {
  std::vector<Number> numbers = sample_numbers<Number>();
  numbers.front() = std::numeric_limits<Number>::lowest();
  numbers.back() = std::numeric_limits<Number>::max();
  return numbers;
}

template <class Number>
std::string packed_numbers(const std::vector<Number>& numbers, ByteOrder order) {
  std::string bytes;
  for (const Number number : numbers) bytes += pack(order, number);
  return bytes;
}

template <class Number>
void expect_extremes(const ScalarVolume& volume, const std::string& name) {
  const std::vector<Number> numbers = extreme_numbers<Number>();
  ASSERT_EQ(volume.values.size(), numbers.size()) << name;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if constexpr (std::is_same_v<Number, double>) {
      if (std::abs(numbers[k]) > 1e300) {  // no float
        EXPECT_TRUE(std::isnan(volume.values[k])) << name;
        continue;
      }
    }
    EXPECT_EQ(volume.values[k], static_cast<float>(numbers[k])) << name;
  }
}

/// Reads a type's extremes from all binary formats that have it; empty names are of those that
/// have not.
template <class Number>
void read_type(std::string_view raw, std::string_view nrrd, std::int16_t nifti,
               std::string_view meta, std::string_view vtk) {
  for (const ByteOrder order : {ByteOrder::Little, ByteOrder::Big}) {
    const bool big = order == ByteOrder::Big;
    const std::string bytes = packed_numbers(extreme_numbers<Number>(), order);
    const std::string endian = fmt::format("endian: {}\n", big ? "big" : "little");
    const std::string name(vtk);
    expect_extremes<Number>(volume_of("a.nrrd", nrrd_header(nrrd, "raw", endian) + "\n" + bytes),
                            name);
    expect_extremes<Number>(
        volume_of("b.nrrd", nrrd_header(nrrd, "gz", endian) + "\n" + gzip(bytes)), name);
    expect_extremes<Number>(
        volume_of("a.nii", nifti_file({.order = order, .datatype = nifti}, bytes)), name);
    const std::string msb = fmt::format("BinaryDataByteOrderMSB = {}\n", big ? "True" : "False");
    expect_extremes<Number>(
        volume_of("a.mha", meta_header(meta, msb + "ElementDataFile = LOCAL\n") + bytes), name);
    for (const bool is_packed : {false, true}) {
      VtkWriter writer({VtkForm::Data::AppendedRaw, is_packed, big, order});
      const std::string array = writer.array(vtk, "Name=\"a\"", extreme_numbers<Number>());
      expect_extremes<Number>(
          volume_of("a.vti", writer.file("ImageData",
                                         "<ImageData><Piece Extent=\"0 1 0 2 0 3\"><PointData>" +
                                             array + "</PointData></Piece></ImageData>")),
          name);
    }
    if (raw.empty()) continue;
    const std::string layout = fmt::format("2x3x4:{}{}", raw, big ? ":be" : ":le");
    expect_extremes<Number>(volume_of("a.raw", bytes, layout), name);
  }
}

TEST(ReadVolumeTest, EveryTypeIsReadInBothByteOrders) {
  read_type<std::uint8_t>("u8", "unsigned char", 2, "MET_UCHAR", "UInt8");
  read_type<std::int8_t>("i8", "signed char", 256, "MET_CHAR", "Int8");
  read_type<std::uint16_t>("u16", "unsigned short int", 512, "MET_USHORT", "UInt16");
  read_type<std::int16_t>("i16", "short", 4, "MET_SHORT", "Int16");
  read_type<std::uint32_t>("u32", "uint32_t", 768, "MET_UINT", "UInt32");
  read_type<std::int32_t>("i32", "int", 8, "MET_INT", "Int32");
  read_type<std::uint64_t>("", "ulonglong", 1280, "MET_ULONG_LONG", "UInt64");
  read_type<std::int64_t>("", "long long", 1024, "MET_LONG_LONG", "Int64");
  read_type<float>("f32", "float", 16, "MET_FLOAT", "Float32");
  read_type<double>("f64", "double", 64, "MET_DOUBLE", "Float64");
}

TEST(ReadVolumeTest, InfinityIsNoValue) {
  const float inf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const ScalarVolume volume = volume_of("a.raw", pack(inf, -inf, nan, 4.F), "2x2x1:f32");
  EXPECT_TRUE(std::isnan(volume.values[0]) && std::isnan(volume.values[1]) &&
              std::isnan(volume.values[2]));
  EXPECT_EQ(volume.values[3], 4.F);
  EXPECT_EQ(volume_error("a.raw", pack(inf, nan), "2x1x1:f32"),
            "holds no value that is a finite number");
}

TEST(ReadVolumeTest, MirroredStepsAreKept) {
  const ScalarVolume volume =
      volume_of("a.mha",
                "NDims = 3\nDimSize = 2 3 4\nElementType = MET_SHORT\n"
                "TransformMatrix = -1 0 0 0 1 0 0 0 1\nElementDataFile = LOCAL\n" +
                    sample_bytes<std::int16_t>());
  expect_sample_values(volume, "a.mha");
  // Left-posterior-superior (-1, 0, 0) is right-anterior-superior (1, 0, 0).
  EXPECT_EQ(node_position(volume, {1, 1, 1}), glm::dvec3(1.0, -1.0, 1.0));
}

TEST(ReadVolumeTest, VtkReadsTheActiveScalarsOrElseTheFirst) {
  VtkWriter writer({});
  const std::string vectors = writer.array("Float32", "Name=\"velocity\" NumberOfComponents=\"3\"",
                                           std::vector<float>(72, 5.F));
  const std::string ghosts =
      writer.array("UInt8", "Name=\"vtkGhostType\"", std::vector<int>(24, 0));
  const std::string other = writer.array("Float32", "Name=\"heat\"", std::vector<float>(24, 7.F));
  expect_sample_values(volume_of("a.vti", vti_file({}, "Int16", vectors + ghosts + other)),
                       "active");
  std::string file = vti_file({}, "Int16", vectors + ghosts + other);
  const std::string active = " Scalars=\"density\"";
  file.erase(file.find(active), active.size());
  EXPECT_EQ(volume_of("a.vti", file).values, std::vector<float>(24, 7.F));
}

TEST(ReadVolumeTest, RemarksOfVtkInAnArrayAreSkipped) {
  const std::string remark = "<InformationKey name=\"L2\">3 4 5</InformationKey>";
  for (const std::string_view where : {"\n</DataArray>", ">\n1 "}) {
    std::string file = vti_file({});
    const std::size_t at = file.find(where);
    ASSERT_NE(at, file.npos);
    file.insert(where.starts_with('>') ? at + 1 : at, remark);
    expect_sample_values(volume_of("a.vti", file), std::string(where));
  }
}

TEST(ReadVolumeTest, AVolumeIsKnownByItsExtension) {
  for (const char* name :
       {"a.nrrd", "a.NHDR", "a.nii", "a.nii.gz", "a.mha", "a.mhd", "b/a.vti", "a.vtr", "a.vts"})
    EXPECT_TRUE(is_volume(name, {})) << name;
  for (const char* name : {"a.raw", "a.gz", "a.ply.gz", "a.zip", "nrrd", "a.vtu", "a.hdr"})
    EXPECT_FALSE(is_volume(name, {})) << name;
  EXPECT_TRUE(is_volume("a.raw", {RawLayout{}, {}}));
  EXPECT_EQ(volume_error("a.raw", "abc"),
            "its extension is not of a volume (.nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd, .vti, .vtr "
            "and .vts); a file without a header needs its layout, as in --raw 256x256x109:u8");
}

TEST(ReadVolumeTest, LayoutsAreParsed) {
  const auto layout = parse_raw_layout("256x255x109:i16:be:1,1.5,2.5e-1");
  ASSERT_TRUE(layout) << layout.error().message;
  EXPECT_EQ(layout->size, glm::uvec3(256, 255, 109));
  EXPECT_EQ(layout->form, (NumberForm{NumberType::Int16, true}));
  EXPECT_EQ(layout->spacing, glm::dvec3(1.0, 1.5, 0.25));
  EXPECT_EQ(text_of(*layout), "256x255x109:i16:be:1,1.5,0.25");
  const auto turned = parse_raw_layout("1x2x3:f64:1,2,3:be");
  ASSERT_TRUE(turned) << turned.error().message;
  EXPECT_TRUE(turned->form.is_big_endian);
  for (const char* bad :
       {"", "256x256:u8", "256x256x109", "256x256x0:u8", "256x256x-1:u8", "4294967296x1x1:u8",
        "1x1x1:u9", "1x1x1:u8:be:le", "1x1x1:u8:0,1,1", "1x1x1:u8:nan,1,1", "1x1x1:u8:1,1",
        "1x1x1:u8:x", "1x1x1x1:u8", "1x1x1:u8:1,1,1:1,1,1"})
    EXPECT_FALSE(parse_raw_layout(bad)) << bad;
  EXPECT_EQ(parse_raw_layout("2x2x2:int").error().message,
            "raw layout '2x2x2:int': expected the type u8, i8, u16, i16, u32, i32, f32 or f64, "
            "found 'int'; a layout is SIZExSIZExSIZE:TYPE[:be][:X,Y,Z], as in 256x256x109:u8 or "
            "64x64x32:f32:be:1,1,2.5");
}

/// Stops a job once this many units are done.
class StoppingProgress final : public Progress {
 public:
  void advance(std::uint64_t units) override { done_ += units; }
  [[nodiscard]] bool cancelled() const override { return done_ > 0; }
  [[nodiscard]] std::uint64_t done() const { return done_; }

 private:
  std::atomic<std::uint64_t> done_ = 0;
};

TEST(ReadVolumeTest, ReadingCanBeInterrupted) {
  const std::string values(std::size_t{8} << 20U, 'a');
  const RawLayout layout{{2048, 1024, 4}, {NumberType::Uint8, false}};
  for (const auto& [name, bytes] :
       {std::pair<std::string, std::string>{"a.raw", values}, {"a.raw.gz", gzip(values)}}) {
    StoppingProgress progress;
    const auto volume =
        read_volume_bytes(name, std::as_bytes(std::span(bytes)), {layout, {}}, progress);
    ASSERT_FALSE(volume);
    EXPECT_EQ(volume.error().message, "interrupted");
    EXPECT_LT(progress.done(), bytes.size());
  }
}

}  // namespace
}  // namespace relief::test

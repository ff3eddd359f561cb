// Writes the first inputs of each fuzz target: the small files that the tests make.
//   relief_fuzz_seeds OUT_FOLDER TEST_DATA_FOLDER
#include <turbojpeg.h>

#include <filesystem>
#include <string>

#include "common/image/image_formats.h"
#include "common/patch_file/patch_file.h"
#include "preprocess/readers/format.h"
#include "preprocess/volumes/dicom/dicom_slice.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/preprocess/gaussians/gaussian_files.h"
#include "tests/preprocess/readers/sample_files.h"
#include "tests/preprocess/volumes/volume_files.h"

namespace relief::test {
namespace {

namespace fs = std::filesystem;

/// Puts one input into a target's folder.
class Seeds {
 public:
  explicit Seeds(fs::path folder) : folder_(std::move(folder)) {}

  void add(const std::string& target, const std::string& name, const std::string& bytes) const {
    fs::create_directories(folder_ / target);
    spill(folder_ / target / name, bytes);
  }
  void add(const std::string& target, const std::string& name,
           const std::vector<std::byte>& bytes) const {
    add(target, name, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  }
  [[nodiscard]] bool has(const std::string& target) const { return fs::exists(folder_ / target); }

 private:
  fs::path folder_;
};

void add_scans(const Seeds& seeds) {
  for (const SampleFile& file : sample_files()) {
    const auto format = find_format(file.name, file.bytes);
    // Packed files are not recognised before they are unpacked.
    seeds.add(format ? std::string((*format)->target()) : "gunzip", file.name, file.bytes);
  }
  seeds.add("ply", "strips.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
            "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
            "property float nx\nproperty float ny\nproperty float nz\nproperty float s\n"
            "property float t\nelement tristrips 1\nproperty list int int vertex_indices\n"
            "end_header\n0 0 0 1 2 3 0 0 1 0 0\n1 0 0 4 5 6 0 0 1 1 0\n0 1 0 7 8 9 0 0 1 0 1\n"
            "4 0 1 2 -1\n");
  seeds.add("obj", "materials.obj",
            "mtllib a.mtl b.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 1 1 0 1 1 1\n"
            "vt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\nusemtl one\nf 1/1 2/2 3/3\nusemtl two\n"
            "f -1/-1 -2/-2 -3/-4 1/2\n");
  seeds.add("mtl", "two.mtl",
            "newmtl one\nKd 1 0.5 0\nmap_Kd -clamp on -o 0 0 0 my picture.png\n"
            "newmtl two\nKd 0.5\nnorm -bm 0.5 normals.png\nmap_Bump -mm 0 1 -s 2 2 2 bump.png\n");
  seeds.add("poses", "two.conf",
            "camera 0 0 -1 0 0 0 1\nbmesh a.ply 0 0 0 0 0 0 1\n"
            "bmesh scans/b.ply 1 2 3 0.5 0.5 0.5 0.5\n");
  for (const auto method :
       {draco::POINT_CLOUD_SEQUENTIAL_ENCODING, draco::POINT_CLOUD_KD_TREE_ENCODING})
    seeds.add("drc", fmt::format("cloud{}", static_cast<int>(method)), drc_cloud(method));
  for (const auto method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING})
    seeds.add("drc", fmt::format("mesh{}", static_cast<int>(method)), drc_mesh(method));
  seeds.add("gunzip", "too_large.gz", gzip(std::string(100000, 'x')));
  seeds.add("gunzip", "two_members.gz", gzip("one") + gzip(std::string(1000, 'x')));
}

/// Four slices that make a stack, each after its flags (fuzz_dicom_stack.cpp), even and uneven,
/// with places and without.
void add_dicom_stacks(const Seeds& seeds) {
  for (const char flags : {'\0', '\4'}) {
    for (const double last : {3.0, 3.5}) {
      std::string bytes;
      for (const double place : {0.0, 1.0, 2.0, last}) {
        DicomSlice slice{};
        slice.series[0] = '1';
        slice.number = static_cast<std::int64_t>(place);
        slice.size = {4, 3, 1};
        slice.spacing = {1.0, 1.0, 1.0};
        slice.position = {0.0, 0.0, place};
        slice.along_row = {1.0, 0.0, 0.0};
        slice.along_column = {0.0, 1.0, 0.0};
        bytes += flags;
        bytes.append(reinterpret_cast<const char*>(&slice), sizeof(slice));
      }
      seeds.add("dicom_stack", fmt::format("{}_{}", static_cast<int>(flags), last), bytes);
    }
  }
}

void add_gaussians(const Seeds& seeds) {
  for (const GaussianFile& file : gaussian_files()) seeds.add("gaussians", file.name, file.bytes);
}

void add_patch_files(const Seeds& seeds, const fs::path& test_data) {
  for (const char* name : {"version1.relief", "version1_scalars.relief", "version2.relief",
                           "version2_scalars.relief", "version3.relief", "version3_seams.relief"})
    seeds.add("patch_file", name, slurp(test_data / name));
  const ScratchFolder scratch;
  for (const PatchCodec codec : {PatchCodec::Fast, PatchCodec::Compact}) {
    PatchModel model = bumpy_model(1, 2);
    model.patches.push_back(bumpy_patch({.width = 3, .height = 2, .colours = 1}));
    const fs::path path = scratch / "a.relief";
    if (write_patch_file(path, model, {.codec = codec}))
      seeds.add("patch_file", fmt::format("coloured{}", static_cast<int>(codec)), slurp(path));
    model.joined = {{0, 2}};
    model.is_closed = true;
    if (write_patch_file(path, model, {.codec = codec}))
      seeds.add("patch_file", fmt::format("joined{}", static_cast<int>(codec)), slurp(path));
  }
}

void add_images(const Seeds& seeds) {
  Image image{4, 3, {}};
  for (const char* name : {"R", "G", "B"})
    image.channels.push_back({name, ChannelType::Half, std::vector<float>(12, 0.5F)});
  if (const auto bytes = encode_png(image)) seeds.add("image", "a.png", *bytes);
  if (const auto bytes = encode_exr(image)) seeds.add("image", "a.exr", *bytes);
  seeds.add("image", "a.hdr",
            "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n" + pack(std::uint32_t{0x08000202}) +
                "\x88\x10\x88\x20\x88\x30\x88\x80");
  seeds.add("image", "flat.hdr", "#?RGBE\nEXPOSURE=2\n\n+Y 1 +X 2\nabcdefgh");
  std::vector<unsigned char> pixels(8 * 8 * 3, 99);
  void* const encoder = tjInitCompress();
  unsigned char* bytes = nullptr;
  unsigned long count = 0;  // NOLINT: as libjpeg-turbo has it
  if (tjCompress2(encoder, pixels.data(), 8, 0, 8, TJPF_RGB, &bytes, &count, TJSAMP_420, 60, 0) ==
      0)
    seeds.add("image", "a.jpg", std::string(reinterpret_cast<const char*>(bytes), count));
  tjFree(bytes);
  tjDestroy(encoder);
}

void add_scenes(const Seeds& seeds) {
  seeds.add("scene", "small.json",
            R"({"models": [{"file": "a.relief"}], "views": [{"name": "v"}]})");
  seeds.add("scene", "full.json",
            R"({"models": [{"file": "a.ply", "transform": {"translation": [1, 2, 3], "rotation":
  {"axis": [0, 1, 0], "degrees": 90}, "scale": 0.5}, "material": "glass", "ior": 1.5,
  "absorption": [1, 0, 0], "interfaces": 2, "closed": true}],
  "size": [640, 480], "env": "sky.hdr", "background": "none", "lights": [{"direction": [1, 1, 0],
  "colour": [1, 1, 1]}, {"position": [0, 0, 1], "intensity": 0.1}], "ambient": [0, 0, 0],
  "views": [{"name": "a", "orbit": [0, 10, 2], "fov": 30, "engine": "onepass", "samples": 4,
  "outputs": ["colour", "depth"]}, {"name": "b", "eye": [0, 1, 2], "target": [0, 0, 0],
  "up": [0, 1, 0], "orthographic": "fit", "exposure": -1.5, "roughness": 0.2, "opacity": 1}]})");
}

void add_camera_paths(const Seeds& seeds) {
  seeds.add("camera_path", "full.json",
            R"({"version": 1, "frames_per_second": 25, "loop": true, "keys": [
  {"name": "a", "time": 0.5, "eye": [0, -5, 1], "target": [0, 0, 0], "up": [0, 0, 1], "fov": 30},
  {"time": 2, "eye": [5e5, 5e6, 1], "target": [5e5, 5e6, 0], "up": [0, 0, 1]},
  {"eye": [0, 5, 1], "target": [0, 0, 0], "up": [0, 0, -1]}]})");
  seeds.add("camera_path", "orthographic.json", R"({"version": 1, "keys": [
  {"eye": [0, 0, 1], "target": [0, 0, 0], "up": [0, 1, 0], "orthographic": 2},
  {"eye": [1, 0, 0], "target": [0, 0, 0], "up": [0, 1, 0], "orthographic": 0.1}]})");
}

void add_volumes(const Seeds& seeds) {
  for (const VolumeFile& file : volume_files()) seeds.add("volume", file.name, file.bytes);
  for (const VolumeFile& file : plain_volume_files()) seeds.add("volume", file.name, file.bytes);
  seeds.add("volume", "detached.nhdr", nrrd_header("short", "raw", "endian: big\ndata file: a\n"));
}

}  // namespace
}  // namespace relief::test

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const relief::test::Seeds seeds(argv[1]);
  relief::test::add_scans(seeds);
  relief::test::add_dicom_stacks(seeds);
  relief::test::add_gaussians(seeds);
  relief::test::add_patch_files(seeds, argv[2]);
  relief::test::add_images(seeds);
  relief::test::add_scenes(seeds);
  relief::test::add_camera_paths(seeds);
  relief::test::add_volumes(seeds);
  for (const relief::PointFormat& format : relief::point_formats()) {
    if (seeds.has(std::string(format.target()))) continue;
    fmt::print(stderr, "{} has no seed: add a file to sample_files()\n", format.name);
    return 1;
  }
  return 0;
}

#include "preprocess/gaussians/read_gaussians.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "common/guard.h"
#include "common/io/mapped_file.h"
#include "preprocess/gaussians/gaussian_readers.h"
#include "preprocess/gaussians/spz_header.h"
#include "preprocess/readers/gzip/gunzip.h"
#include "preprocess/readers/gzip/inflate.h"

namespace relief {
namespace {

/// Headers of Gaussians have 2 KB.
constexpr std::size_t kMostHeaderBytes = std::size_t{1} << 20U;

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The first bytes of a gzip file, decompressed, as far as its header ends: none if it is damaged
/// there. Each scan that is opened is asked.
std::vector<std::byte> unpack_head(const std::string& name, std::span<const std::byte> bytes) {
  std::vector<std::byte> head;
  const Progress progress;
  (void)inflate_pieces(name, bytes, DeflateForm::Gzip, progress,
                       [&](std::span<const std::byte> piece, std::size_t) -> Result<bool> {
                         head.insert(head.end(), piece.begin(), piece.end());
                         return head.size() < kMostHeaderBytes &&
                                text_of(head).find("end_header") == std::string_view::npos;
                       });
  return head;
}

bool has_gaussians(const std::string& name, std::span<const std::byte> head) {
  Progress progress;
  ReadRemarks remarks;
  const auto header =
      read_ply_header({.name = name,
                       .text = text_of(head.first(std::min(head.size(), kMostHeaderBytes))),
                       .progress = progress,
                       .remarks = remarks});
  return header && (has_plain_gaussians(*header) || has_compressed_gaussians(*header));
}

Result<GaussianCloud> read_ply(const Source& source, const PlyHeader& header) {
  if (has_compressed_gaussians(header)) return read_compressed_ply(source, header);
  if (has_plain_gaussians(header)) return read_gaussian_ply(source, header);
  return make_error(
      "{}: its vertices have no properties f_dc_0, opacity, scale_0 and rot_0, so it is not a "
      "scene of Gaussians",
      source.name);
}

Result<GaussianCloud> read_ply_or_spz(const Source& source) {
  if (source.text.starts_with(kSpzMagic) || lower_case(source.name).ends_with(".spz"))
    return read_spz(source);
  RELIEF_TRY_ASSIGN(const auto header, read_ply_header(source));
  RELIEF_TRY_ASSIGN(auto cloud, read_ply(source, header));
  cloud.is_antialiased = header.splat_render_mode == "mip";
  return cloud;
}

Result<GaussianCloud> read_unpacked(const std::string& name, std::span<const std::byte> bytes,
                                    Progress& progress) {
  ReadRemarks remarks;
  const Source packed{
      .name = name, .text = text_of(bytes), .progress = progress, .remarks = remarks};
  if (!is_gzip(bytes) || lower_case(name).ends_with(".spz")) {
    progress.begin_stage("read", bytes.size());
    return read_ply_or_spz(packed);
  }
  progress.begin_stage("decompress", 0);
  RELIEF_TRY_ASSIGN(const auto unpacked, gunzip(name, bytes, largest_unpacked(), progress));
  progress.begin_stage("read", unpacked.size());
  return read_ply_or_spz(
      {.name = name, .text = text_of(unpacked), .progress = progress, .remarks = remarks});
}

}  // namespace

Result<bool> is_gaussians(const std::filesystem::path& path) {
  const std::string name = path.string();
  const std::string lower = lower_case(name);
  if (lower.ends_with(".spz")) return true;
  if (!lower.ends_with(".ply") && !lower.ends_with(".ply.gz")) return false;
  RELIEF_TRY_ASSIGN(const auto file, MappedFile::open(path));
  if (!is_gzip(file.bytes())) return has_gaussians(name, file.bytes());
  return has_gaussians(name, unpack_head(name, file.bytes()));
}

Result<GaussianCloud> read_gaussian_bytes(const std::filesystem::path& path,
                                          std::span<const std::byte> bytes, Progress& progress) {
  const std::string name = path.string();
  return guarded({.subject = name,
                  .task = "read it",
                  .advice = "the file may be damaged: write it again",
                  .memory_advice = "remove Gaussians from the scene"},
                 [&] { return read_unpacked(name, bytes, progress); });
}

Result<GaussianCloud> read_gaussians(const std::filesystem::path& path, Progress& progress) {
  RELIEF_TRY_ASSIGN(const auto file, MappedFile::open(path));
  return read_gaussian_bytes(path, file.bytes(), progress);
}

}  // namespace relief

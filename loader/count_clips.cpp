#include "loader/count_clips.h"

#include <utility>

#include "common/patch_file/patch_file.h"
#include "loader/load_files.h"
#include "renderer/engines/ewa/clipped_cloud.h"
#include "renderer/engines/ewa/settings.h"
#include "renderer/geometry/splats_of_samples.h"

namespace relief {
namespace {

Result<SplatCloud> load_splats(const std::filesystem::path& path, const ReadOptions& options,
                               Progress& progress) {
  if (names_patch_file(path)) {
    RELIEF_TRY_ASSIGN(const PatchModel model, load_model(path, progress, options));
    return splats_of_samples(model);
  }
  RELIEF_TRY_ASSIGN(ReadResult scan, load_mesh(path, TextureChoice{true, {}}, progress, options));
  auto splats = splats_of_points(std::move(scan.points), progress);
  if (!splats) return make_error("{}: {}", path.string(), splats.error().message);
  return splats;
}

}  // namespace

Result<ClipCounts> count_clips(const std::filesystem::path& path, const ReadOptions& options,
                               const ClipSettings& settings, Progress& progress) {
  RELIEF_TRY_ASSIGN(const SplatCloud cloud, load_splats(path, options, progress));
  RELIEF_TRY_ASSIGN(
      const ClipPartners partners,
      find_clip_partners(ewa::discs_of(cloud, EwaSettings().cutoff), settings, progress));
  return partners.counts;
}

}  // namespace relief

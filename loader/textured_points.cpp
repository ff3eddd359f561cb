#include "loader/textured_points.h"

#include <memory>
#include <utility>
#include <vector>

#include "common/image/image_io.h"
#include "loader/load_files.h"
#include "preprocess/readers/read_points.h"

namespace relief {
namespace {

/// The coordinates of each point, v downward: its own, or those of a triangle's corner.
std::vector<glm::vec2> texcoords_by_point(const Points& points) {
  std::vector<glm::vec2> texcoords = points.texcoords;
  if (texcoords.empty() && !points.corner_texcoords.empty()) {
    texcoords.resize(points.size(), glm::vec2(0.0F));
    for (std::size_t t = 0; t < points.triangles.size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c)
        texcoords[points.triangles[t][c]] = points.corner_texcoords[t][c];
    }
  }
  for (glm::vec2& texcoord : texcoords) texcoord.y = 1.0F - texcoord.y;
  return texcoords;
}

}  // namespace

Result<SplatCloud> load_textured_points(const std::filesystem::path& mesh,
                                        const TextureChoice& choice, Progress& progress) {
  RELIEF_TRY_ASSIGN(auto texture, read_image(choice.image));
  RELIEF_TRY_ASSIGN(auto scan, read_points(mesh, progress));
  if (choice.flips_v) flip_v(scan.points);
  std::vector<glm::vec2> texcoords = texcoords_by_point(scan.points);
  if (texcoords.empty()) {
    return make_error("{}: has no texture coordinates for {}", mesh.string(),
                      choice.image.string());
  }
  scan.points.colours.clear();
  RELIEF_TRY_ASSIGN(SplatCloud cloud, splats_of_points(std::move(scan.points), progress));
  cloud.texcoords = std::move(texcoords);
  cloud.texture = std::make_shared<const Image>(std::move(texture));
  return cloud;
}

}  // namespace relief

#include "common/patch_file/patch_tree.h"

#include "common/io/file.h"
#include "common/patch_file/patch_tree_layout.h"

namespace relief {

Result<PatchTree> PatchTree::open(const std::filesystem::path& path) {
  RELIEF_TRY_ASSIGN(const auto file, RandomAccessFile::open(path));
  RELIEF_TRY_ASSIGN(auto layout, read_tree_layout(file, path.string()));
  PatchTree tree;
  tree.path_ = path;
  tree.extent_.spacing = layout.header.spacing;
  tree.extent_.bounds = layout.header.bounds;
  tree.extent_.bounding_radius = layout.header.bounding_radius;
  tree.extent_.is_closed = layout.header.is_closed;
  tree.extent_.extremes = std::move(layout.header.block.extremes);
  tree.extent_.stance = layout.header.block.stance;
  tree.extent_.scalars = std::move(layout.header.block.scalars);
  tree.tiles_ = std::move(layout.tiles);
  return tree;
}

Result<PatchFile> PatchTree::open_tile(std::uint32_t tile) const {
  assert(tile < tiles_.size() && "the caller checks tiles()");
  RELIEF_TRY_ASSIGN(PatchFile file, PatchFile::open_tile(path_, tiles_[tile]));
  if (!extent_.scalars.empty() && file.info().scalars != extent_.scalars) {
    return make_error("{}: its scalars are not those of the model; the file is damaged",
                      file.name());
  }
  return file;
}

}  // namespace relief

// A model on the GPU: the patch table, the sample records or the cells of the patches' levels, the
// maps in array textures.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "renderer/geometry/cells/levels.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/store/cell_store.h"
#include "renderer/store/proxy_store.h"
#include "renderer/store/sample_pages.h"
#include "renderer/store/seam_store.h"
#include "renderer/view/cull_mode.h"
#include "renderer/view/view.h"

namespace relief {

/// What a store holds; what no feature reads is not uploaded.
struct StoreNeeds {
  bool splats = false;   ///< a record a sample
  bool heights = false;  ///< height maps
  bool cells = false;
  bool normals = false;
  bool colours = false;
  bool masks = false;    ///< for coarser levels
  bool sources = false;  ///< which samples the vertices of models seen from afar stand for
  bool bodies = false;   ///< how large the model is that a patch belongs to

  bool operator==(const StoreNeeds&) const = default;
};

/// What the CPU keeps of a level of a patch on the GPU. World frame, in double precision.
struct StoredPatch {
  std::uint32_t level = 0;
  std::uint8_t material = 0;   ///< as Patch::material
  std::uint32_t instance = 0;  ///< in PatchStore::instances
  glm::dvec3 origin{0.0};
  glm::dmat3 axes{1.0};
  double spacing = 1.0;
  std::uint32_t side = 0;  ///< nodes along its longer side
  glm::dvec3 centre{0.0};  ///< of a sphere about all of its splats
  double radius = 0.0;
  double widest_disc = 0.0;  ///< radius that no splat of it exceeds, world units
  RecordRun records;         ///< none without StoreNeeds::splats
};

/// What the CPU keeps of a placed patch whatever its level.
struct StoredLevels {
  PatchExtent extent;
  std::uint32_t first = 0;  ///< in PatchStore::patches, finest first
  std::uint32_t count = 0;
};

/// An instance of the model; one without instances is a single one.
struct StoredInstance {
  Proxy model;              ///< world
  std::uint32_t first = 0;  ///< in PatchStore::levels
  std::uint32_t count = 0;  ///< 0 where every view draws it from afar
  PatchRun seams = {};      ///< in SeamStore::seams
  /// What stands for it, if some view draws it from afar.
  struct StoredProxy {
    std::uint32_t mesh = 0;    ///< in ProxyStore::meshes
    std::uint32_t patch = 0;   ///< of its frame in PatchStore::patches
    std::uint32_t number = 0;  ///< in ProxyStore::patches
  };
  std::optional<StoredProxy> proxy;
  bool is_mirrored = false;  ///< fronts and backs change places
  std::optional<Body> body;  ///< if it is known to be closed and some view makes use of that

  /// Whether the view draws it from afar.
  [[nodiscard]] bool is_proxy_in(const View& view) const {
    return proxy && (count == 0 || is_proxy(view, model));
  }
};

/// The model on the GPU.
struct PatchStore {
  std::vector<StoredInstance> instances = {};
  std::vector<StoredPatch> patches = {};  ///< each level that is kept of each placed patch
  std::vector<StoredLevels> levels = {};  ///< of each placed patch, one instance after the other
  std::vector<Table> pages = {};  ///< sample records; more than one for a model that is larger than
                                  ///< what OpenGL lets a shader see of one buffer, and in a pool
  Table table;                    ///< shared::PatchInfo, parallel to `patches`
  std::optional<Table> bodies = {};    ///< R32F: diameter of the sphere about the model that it
                                       ///< belongs to (world units), parallel to `patches`
  std::optional<Buffer> indices = {};  ///< 0, 1, 2 ...: the per-instance attribute that names the
                                       ///< patch; cells alone have CellStore::positions instead
  std::optional<Texture> heights = {};
  std::optional<Texture> normals = {};
  std::optional<Texture> colours = {};
  std::optional<Texture> masks = {};
  std::optional<CellStore> cells = {};
  std::optional<ProxyStore> proxies = {};
  std::optional<SeamStore> seams = {};
  /// How often a pool (patch_pool.h) has replaced `positions`, `indices` or grown `patches`: what
  /// is made of these is then out of date.
  std::uint32_t buffers_version = 0;
  /// How often it has changed what programs depend on: kinds of cells, the widest patch.
  std::uint32_t programs_version = 0;
};

/// The views that a model is uploaded for.
struct UploadViews {
  std::span<const View> views = {};
  bool all_levels = false;   ///< also those that none of the views chooses
  std::uint32_t finest = 0;  ///< of all levels; of patches that have none as coarse their coarsest
};

/// The level that the view chooses of each patch of the instances that it shows from near, as
/// indices of `patches`. (The nearest one that is kept, for a view that the model was not uploaded
/// for.)
[[nodiscard]] std::vector<std::uint32_t> levels_for(const PatchStore& store, const View& view);

/// In place of a level: the patch's instance is drawn from afar, as a mesh.
inline constexpr std::uint8_t kDrawnFromAfar = 255;

/// The level that the view draws of each placed patch: `store.levels`' order, which is that of
/// patch ids if all levels are kept.
[[nodiscard]] std::vector<std::uint8_t> drawn_levels(const PatchStore& store, const View& view);

}  // namespace relief

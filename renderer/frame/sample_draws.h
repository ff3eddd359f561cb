// Draws the samples of a stored model, as points or quads: what every engine on OpenGL shares.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/store/patch_store.h"
#include "renderer/view/sided_list.h"
#include "renderer/view/view.h"

namespace relief {

/// What is rasterised for a sample: 1, 3 or 4 vertices. A vertex's sample is its number over that.
enum class SampleShape : std::uint8_t { Points, Triangles, Quads };

/// One multi-draw-indirect per page that has any of the patches; good for any number of passes.
struct SampleDraw {
  struct Page {
    std::uint32_t number = 0;  ///< in PatchStore::pages
    GLuint records = 0;        ///< texture of the page's sample records
    Buffer commands;
    GLsizei count = 0;
    bool front_alone = false;  ///< without the samples that face away
  };
  SampleShape shape = SampleShape::Quads;
  std::vector<Page> pages;
};

/// What shaders read beside the sample records of each page.
struct PageTables {
  GLuint unit = 0;                             ///< texture unit
  const std::vector<Table>* tables = nullptr;  ///< parallel to PatchStore::pages
};

/// The vertex arrays and per-frame tables of a stored model. The store and `gl` must outlive it.
class SampleDraws {
 public:
  /// `cells`: for programs over the store's cells instead, whose instances are parts of patches.
  SampleDraws(const Gl& gl, const PatchStore& store, bool cells = false);

  /// Makes anew what was made of the store's buffers, which have been replaced.
  void renew();

  /// Relates the visible patches to the frame's camera.
  void look(const View& view, const std::vector<std::uint32_t>& visible) const;

  /// Draws these patches, in this order.
  [[nodiscard]] SampleDraw make_draw(SampleShape shape, const SidedList& patches) const;

  /// Runs the program over them; with points it must have RELIEF_FEATURE_FRONT where some have the
  /// front alone. The model must be bound (BoundModel).
  void draw(const SampleDraw& samples, const Program& program, const PageTables& beside = {}) const;

  [[nodiscard]] const PatchStore& store() const { return *store_; }

 private:
  friend class BoundModel;
  const Gl* gl_;
  const PatchStore* store_;
  bool cells_;
  Buffer quad_corners_;  ///< two triangles per quad, for kQuadsPerCommand quads
  VertexArray vertices_;
  Table patch_views_;  ///< shared::PatchView per patch, rewritten each frame
};

/// OpenGL's largest point in pixels.
[[nodiscard]] double largest_sprite(const Gl& gl);

/// While it lives, the model's tables and maps are bound, and depth is tested: reversed, nearer
/// passes. `environment` may be null where no shader reads it.
class BoundModel {
 public:
  BoundModel(const Gl& gl, const SampleDraws& samples, const Texture* environment);
  ~BoundModel();
  BoundModel(const BoundModel&) = delete;
  BoundModel& operator=(const BoundModel&) = delete;

 private:
  const Gl& gl_;
};

}  // namespace relief

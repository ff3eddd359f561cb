// The far side of glass with two interfaces: the nearest surface that is seen from behind.
#pragma once

#include <cstdint>

#include "common/error.h"
#include "renderer/engines/onepass/cell_list.h"
#include "renderer/engines/onepass/visibility.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/store/patch_store.h"
#include "renderer/view/view.h"

namespace relief::onepass {

/// How much more than the image it shows on each side, as a share of the image's longer side:
/// rays leave bodies that reach beyond the image there.
inline constexpr double kBackBorder = 0.125;

/// One for each image, of its whole and one sample a pixel, also for a part of it that has
/// several.
struct Back {
  View view;
  MaterialChoice materials;  ///< of the bodies
  Texture z_buffer;
  Visibility found;  ///< with depths: 0 where nothing was found
  Buffer uniforms;   ///< shared::Frame of `view`
};

/// Makes it for an image with this view. Fails if OpenGL lacks memory.
Result<Back> make_back(const Gl& gl, const View& whole, MaterialChoice materials,
                       Features features);

/// Clears it for a frame.
void clear_back(const Gl& gl, const Back& back);

/// Binds what the shading of bodies reads of it, and how large they are (PatchStore::bodies).
void bind_back(const Gl& gl, const Back& back, const Table& bodies);
void unbind_back(const Gl& gl);

}  // namespace relief::onepass

// The inspection "distance to the points": the open files loaded another time, coloured by it.
#pragma once

#include <memory>

#include "viewer/session.h"

namespace relief {

/// Begins to load the files so while that inspection is chosen. Returns the scene to be shown again
/// when it no longer is, once; null otherwise. Call it once a turn of the window's loop.
[[nodiscard]] std::shared_ptr<const LoadedScene> follow_distance(Session& session);

/// Chooses the picture again after the files could not be loaded so. `is_other`: they are others
/// than those shown, and are loaded again without distances.
void give_up_distance(Session& session, bool is_other);

}  // namespace relief

#include "viewer/distance_colours.h"

#include <utility>

#include "common/scalar.h"

namespace relief {

std::shared_ptr<const LoadedScene> follow_distance(Session& session) {
  InspectionState& state = session.inspected;
  const bool wants = session.inspection == Inspection::Distance;
  if (wants == state.is_distance_loaded || session.scene == nullptr) return nullptr;
  Document& document = session.document;
  if (wants) {
    state.is_distance_loaded = true;
    state.scene_before = session.scene;
    state.colour_by_before =
        std::exchange(document.options().colour_by, ColourBy{.scalar = kDistanceScalar});
    document.reload(session.look);
    return nullptr;
  }
  state.is_distance_loaded = false;
  document.options().colour_by = std::exchange(state.colour_by_before, std::nullopt);
  auto before = std::exchange(state.scene_before, nullptr);
  if (before == nullptr)
    document.reload(session.look);
  else
    document.cancel();
  return before == session.scene ? nullptr : before;
}

void give_up_distance(Session& session, bool is_other) {
  InspectionState& state = session.inspected;
  if (!state.is_distance_loaded) return;
  state.is_distance_loaded = false;
  state.scene_before.reset();
  session.inspection = Inspection::Picture;
  session.document.options().colour_by = std::exchange(state.colour_by_before, std::nullopt);
  if (is_other) session.document.reload(session.look);
}

}  // namespace relief

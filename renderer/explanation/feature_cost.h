// What a feature of a scene costs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace relief {

/// What a frame takes.
struct FrameCost {
  std::uint64_t bytes = 0;          ///< of the buffers and textures that its draw calls have bound
  std::vector<std::string> passes;  ///< in their order
  std::uint64_t lines = 0;     ///< of the variants that it draws with (Explanation::Variant::lines)
  double frame_ms = 0.0;       ///< median
  bool reads_normals = false;  ///< of the model
  bool reads_colours = false;
};

/// A frame less one that is drawn without a feature. Below 0 where the feature saves.
struct FeatureCost {
  std::string feature;
  std::string instead;  ///< what the other frame has in its place, as a clause; may be empty
  std::int64_t bytes = 0;
  std::vector<std::string> passes;        ///< that only the frame with it has
  std::vector<std::string> saved_passes;  ///< that only the one without it has
  std::int64_t lines = 0;
  double frame_ms = 0.0;       ///< median of the differences of frames that were drawn in turns
  double spread_ms = 0.0;      ///< between their quartiles
  bool reads_normals = false;  ///< nothing else of the scene reads normals from the model
  bool reads_colours = false;  ///< nothing else of the scene reads colours from the model
};

/// What all features of a frame cost.
struct FeatureCosts {
  FrameCost whole;  ///< the frame
  FrameCost rest;   ///< the frame without any of the features
  std::vector<FeatureCost> features;
  int turns = 0;  ///< frames of each
};

}  // namespace relief

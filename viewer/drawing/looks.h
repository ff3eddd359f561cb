// What the window shows of a model: one look, or two beside a divider.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/settings.h"
#include "renderer/viewport.h"
#include "viewer/drawing/pacer.h"

namespace relief {

/// Settings of the whole window: the same camera and size in both.
struct Looks {
  RenderSettings first;
  std::optional<RenderSettings> second;  ///< right of the divider
  double divider = 0.5;                  ///< share of the width, 0 to 1
};

/// Returns the one or two.
[[nodiscard]] std::vector<RenderSettings> list_of(const Looks& looks);

/// A look and where it is shown.
struct Pane {
  RenderSettings settings;
  Rectangle part;
};

/// Returns the panes of the picture at its full size, with at most `samples` samples a pixel.
[[nodiscard]] std::vector<Pane> panes_of(const Looks& looks, int samples);

/// Returns the most samples a pixel that a look has.
[[nodiscard]] int most_samples(const Looks& looks);

/// Returns the panes of a coarser picture of the same, one sample a pixel.
[[nodiscard]] std::vector<Pane> panes_of(const Looks& looks, const Quality& quality);

/// Returns the settings of those panes.
[[nodiscard]] std::vector<RenderSettings> list_of(const Looks& looks, const Quality& quality);

}  // namespace relief
